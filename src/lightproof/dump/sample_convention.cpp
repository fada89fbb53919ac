#include "lightproof/dump/sample_convention.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/text_escapes.h"

namespace lightproof {
namespace {

constexpr std::string_view kAxes = "xyz";

[[noreturn]] void refuse_axes(std::string_view text) {
  throw InputError(
      fmt::format("\"{}\" names no axes: three are needed, each once, perhaps with a minus, as in "
                  "x,-z,y for a program whose y is up",
                  terminal_text(text)));
}

}  // namespace

AxisMap AxisMap::parse(std::string_view text) {
  AxisMap map;
  std::array<bool, 3> taken = {};
  std::string_view rest = text;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i > 0) {
      if (!rest.starts_with(',')) refuse_axes(text);
      rest.remove_prefix(1);
    }
    map.sign_[i] = rest.starts_with('-') ? -1 : 1;
    if (rest.starts_with('-') || rest.starts_with('+')) rest.remove_prefix(1);
    const std::size_t axis = rest.empty() ? std::string_view::npos : kAxes.find(rest.front());
    if (axis == std::string_view::npos || taken[axis]) refuse_axes(text);
    taken[axis] = true;
    map.axis_[i] = static_cast<int>(axis);
    rest.remove_prefix(1);
  }
  if (!rest.empty()) refuse_axes(text);
  return map;
}

std::array<AxisMap, 48> AxisMap::make_all() {
  constexpr std::size_t kSigns = 8;
  std::array<AxisMap, 48> maps;
  std::array<int, 3> axes = {0, 1, 2};
  for (std::size_t at = 0; at < maps.size(); ++at) {
    const std::size_t signs = at % kSigns;
    if (at > 0 && signs == 0) std::next_permutation(axes.begin(), axes.end());
    maps[at].axis_ = axes;
    for (std::size_t i = 0; i < 3; ++i) maps[at].sign_[i] = (signs >> i & 1U) != 0 ? -1 : 1;
  }
  return maps;
}

const std::array<AxisMap, 48>& AxisMap::all() {
  static const std::array<AxisMap, 48> maps = make_all();
  return maps;
}

AxisMap AxisMap::after(const AxisMap& first) const {
  AxisMap both;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto middle = static_cast<std::size_t>(axis_[i]);
    both.axis_[i] = first.axis_[middle];
    both.sign_[i] = sign_[i] * first.sign_[middle];
  }
  return both;
}

AxisMap AxisMap::inverse() const {
  AxisMap back;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto theirs = static_cast<std::size_t>(axis_[i]);
    back.axis_[theirs] = static_cast<int>(i);
    back.sign_[theirs] = sign_[i];
  }
  return back;
}

std::string AxisMap::text() const {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) {
    text += fmt::format("{}{}{}", i == 0 ? "" : ",", sign_[i] < 0 ? "-" : "",
                        kAxes[static_cast<std::size_t>(axis_[i])]);
  }
  return text;
}

bool AxisMap::mirrors() const {
  // The sign of the permutation: its three axes stand in a cycle or not.
  const bool is_cycle = (axis_[1] - axis_[0] + 3) % 3 == 1;
  const int sign = sign_[0] * sign_[1] * sign_[2] * (is_cycle ? 1 : -1);
  return sign < 0;
}

AxisMap axes_of(Preset preset) {
  switch (preset) {
    case Preset::openexr:
    case Preset::exr_area:
    case Preset::mitsuba:
      // Their (X, Y, Z) is Lightproof's (y, z, x): see preset.h.
      return AxisMap::parse("z,x,y");
    case Preset::cube:
      // A cube's left-handed (X, Y, Z) is Lightproof's (-x, z, -y): see cube.h.
      return AxisMap::parse("-x,-z,y");
    case Preset::z_up:
    case Preset::z_up_half_turn:
    case Preset::pbrt_v3:
    case Preset::pbrt_v4:
      break;
  }
  return {};
}

}  // namespace lightproof
