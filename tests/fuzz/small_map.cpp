#include "tests/fuzz/small_map.h"

#include <cmath>
#include <limits>
#include <vector>

namespace lightproof::fuzz {
namespace {

Mapping any_mapping(Input& input, Extent texels) {
  Mapping mapping;
  switch (input.below(8)) {
    case 1:
      mapping.shift = 0.25;
      break;
    case 2:
      if (texels.height >= 2) mapping = node_mapping(texels);
      break;
    case 3:
      mapping.kind = MappingKind::octahedral;
      break;
    case 4:
      mapping.kind = MappingKind::cube_strip;
      break;
    default:  // most often that of the library's own frame
      break;
  }
  return size_fault(mapping, texels).empty() ? mapping : Mapping{};
}

/// What has been hard for tables.
constexpr float kHard[] = {0.0F,
                           -0.0F,
                           1.0F,
                           std::numeric_limits<float>::denorm_min(),
                           std::numeric_limits<float>::min(),
                           std::numeric_limits<float>::max(),
                           1e9F,
                           1e-9F,
                           std::numeric_limits<float>::infinity(),
                           std::numeric_limits<float>::quiet_NaN(),
                           -1.0F};

float any_value(Input& input) {
  const std::size_t kind = input.below(32);
  return kind < std::size(kHard) ? kHard[kind] : input.take<float>();
}

}  // namespace

EnvironmentMap small_map(Input& input, Values values) {
  constexpr std::size_t kMostWide = 40;
  constexpr std::size_t kMostHigh = 24;
  const auto width = static_cast<int>(1 + input.below(kMostWide));
  const auto height = static_cast<int>(1 + input.below(kMostHigh));
  EnvironmentMap map{.name = "fuzz", .radiance = Grid<Rgb>({width, height})};
  map.mapping = any_mapping(input, map.radiance.extent());
  if (input.below(4) == 0) map.weights = kAverageLuminance;
  std::vector<float> palette;
  for (std::size_t left = 1 + input.below(32); left > 0; --left) {
    const float value = any_value(input);
    const bool is_radiance = value >= 0.0F && std::isfinite(value);
    palette.push_back(values == Values::any || is_radiance ? value : 0.0F);
  }
  const bool is_grey = input.below(2) == 0;
  const std::size_t step = 1 + input.below(31);
  std::size_t next = 0;
  for (Rgb& texel : map.radiance.values()) {
    for (int i = 0; i < 3; ++i) {
      texel[i] = palette[next % palette.size()];
      if (!is_grey || i == 2) next += step;
    }
  }
  // A few that are where the input says.
  for (std::size_t left = input.below(8); left > 0; --left) {
    const auto x = static_cast<int>(input.below(static_cast<std::size_t>(width)));
    const auto y = static_cast<int>(input.below(static_cast<std::size_t>(height)));
    map.radiance(x, y) = Rgb(palette[input.below(palette.size())]);
  }
  return map;
}

DensitySpace density_space(Input& input) {
  return kDensitySpaces[input.below(kDensitySpaces.size())];
}

}  // namespace lightproof::fuzz
