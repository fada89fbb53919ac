#include "lightproof/image/texel_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lightproof/core/parallel.h"

namespace lightproof {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

constexpr std::array<TexelFault, 3> kNoFaults = {
    TexelFault{.kind = "NaN"},
    TexelFault{.kind = kInfiniteValues},
    TexelFault{.kind = "negative values"},
};

std::array<bool, 3> faults_of(Rgb rgb) {
  const auto any = [&](auto&& fails) { return fails(rgb.r) || fails(rgb.g) || fails(rgb.b); };
  return {any([](float v) { return std::isnan(v); }), any([](float v) { return std::isinf(v); }),
          any([](float v) { return v < 0.0F && !std::isinf(v); })};
}

bool is_radiance(float v) { return std::isfinite(v) && v >= 0.0F; }

void count(TexelFault& fault, int column, int row) {
  if (fault.count++ == 0) {
    fault.column = column;
    fault.row = row;
  }
}

TexelScan scan_row(const Grid<Rgb>& picture, int y) {
  TexelScan scan{.faults = kNoFaults};
  for (int x = 0; x < picture.extent().width; ++x) {
    const Rgb rgb = picture(x, y);
    for (const float v : {rgb.r, rgb.g, rgb.b}) {
      if (is_radiance(v)) scan.brightest = std::max(scan.brightest, v);
    }
    if (is_radiance(rgb.r) && is_radiance(rgb.g) && is_radiance(rgb.b)) continue;
    const std::array<bool, 3> found = faults_of(rgb);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found[i]) count(scan.faults[i], x, y);
    }
  }
  return scan;
}

void merge(TexelScan& whole, const TexelScan& below) {
  whole.brightest = std::max(whole.brightest, below.brightest);
  for (std::size_t i = 0; i < whole.faults.size(); ++i) {
    const std::size_t earlier = whole.faults[i].count;
    if (earlier == 0) whole.faults[i] = below.faults[i];
    whole.faults[i].count = earlier + below.faults[i].count;
  }
}

}  // namespace

bool TexelScan::clean() const {
  return std::ranges::all_of(faults, [](const TexelFault& fault) { return fault.count == 0; });
}

std::size_t TexelScan::count_of(std::string_view kind) const {
  const auto found = std::ranges::find(faults, kind, &TexelFault::kind);
  return found == faults.end() ? 0 : found->count;
}

TexelScan scan_texels(const Grid<Rgb>& picture) {
  const auto height = static_cast<std::size_t>(picture.extent().height);
  std::vector<TexelScan> rows(height);
  parallel_for(height, [&](std::size_t y) { rows[y] = scan_row(picture, static_cast<int>(y)); });
  TexelScan whole{.faults = kNoFaults};
  for (const TexelScan& row : rows) merge(whole, row);
  return whole;
}

std::string describe_fault(const TexelFault& fault) {
  return fmt::format("{} {} with {} ({} column {}, row {})", fault.count,
                     fault.count == 1 ? "texel" : "texels", fault.kind,
                     fault.count == 1 ? "at" : "the first at", fault.column, fault.row);
}

std::string describe_faults(const TexelScan& scan) {
  std::string text;
  for (const TexelFault& fault : scan.faults) {
    if (fault.count > 0) text += (text.empty() ? "" : ", ") + describe_fault(fault);
  }
  return text;
}

void repair_texels(Grid<Rgb>& picture, float infinite) {
  parallel_for(static_cast<std::size_t>(picture.extent().height), [&](std::size_t y) {
    for (Rgb& rgb : picture.row(static_cast<int>(y))) {
      for (float* v : {&rgb.r, &rgb.g, &rgb.b}) {
        if (!is_radiance(*v)) *v = *v == kInfinity ? infinite : 0.0F;
      }
    }
  });
}

Grid<Rgb> infinite_channels(const Grid<Rgb>& picture) {
  const auto mark = [](float v) { return v == kInfinity ? 1.0F : 0.0F; };
  Grid<Rgb> marks(picture.extent());
  std::ranges::transform(picture.values(), marks.values().begin(),
                         [&](Rgb rgb) { return Rgb(mark(rgb.r), mark(rgb.g), mark(rgb.b)); });
  return marks;
}

}  // namespace lightproof
