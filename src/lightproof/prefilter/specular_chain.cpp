#include "lightproof/prefilter/specular_chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lightproof/core/error.h"
#include "lightproof/image/map_levels.h"
#include "lightproof/prefilter/radiance_look_up.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {

std::vector<Extent> level_extents(Extent extent, int levels) {
  check_map_size(Projection::lat_long, extent);
  check_level_count(extent, levels);
  std::vector<Extent> extents;
  for (int level = 0; level < levels; ++level) extents.push_back(level_extent(extent, level));
  return extents;
}

std::vector<double> level_roughness(int levels) {
  std::vector<double> roughness;
  for (int level = 0; level < levels; ++level) {
    roughness.push_back(static_cast<double>(level) / std::max(1, levels - 1));
  }
  return roughness;
}

void check_roughness(double roughness) {
  if (roughness >= 0.0 && roughness <= 1.0) return;
  throw InputError(fmt::format("a roughness of {}: 0 (a mirror) to 1 needed", roughness));
}

std::optional<Lobe> ggx_lobe(double roughness, GgxWeight weight, double f0) {
  check_roughness(roughness);
  // Below, the lobe is narrower than the rounding of a direction.
  constexpr double kLeastAlpha = 1e-7;
  if (alpha_of_roughness(roughness) < kLeastAlpha) return std::nullopt;
  return GgxLobe{alpha_of_roughness(roughness), weight, f0};
}

SpecularChain ggx_chain(const Grid<Rgb>& map, Extent extent, int levels, GgxWeight weight,
                        const PrefilterSettings& settings) {
  const std::vector<Extent> extents = level_extents(extent, levels);
  const std::vector<double> roughness = level_roughness(levels);
  std::vector<PrefilteredLevel> wanted;
  for (std::size_t i = 0; i < extents.size(); ++i) {
    wanted.push_back({ggx_lobe(roughness[i], weight), extents[i]});
  }
  return prefilter(map, wanted, settings);
}

SpecularChain phong_chain(const Grid<Rgb>& map, Extent extent, std::span<const double> exponents,
                          PhongAxis axis, const PrefilterSettings& settings) {
  const std::vector<Extent> extents = level_extents(extent, static_cast<int>(exponents.size()));
  std::vector<PrefilteredLevel> wanted;
  for (std::size_t i = 0; i < extents.size(); ++i) {
    if (!(exponents[i] >= 0.0) || std::isinf(exponents[i])) {
      throw InputError(
          fmt::format("a Phong exponent of {}: a number from 0 on needed", exponents[i]));
    }
    const double cosines = axis == PhongAxis::all_one ? 1.0 : 0.0;
    wanted.push_back({PhongLobe{exponents[i] + cosines}, extents[i]});
  }
  return prefilter(map, wanted, settings);
}

Rgb look_up(const SpecularChain& chain, Direction direction, double level) {
  assert(!chain.empty());
  const double clamped = std::clamp(level, 0.0, static_cast<double>(chain.size() - 1));
  const auto finer = static_cast<std::size_t>(clamped);
  const double between = clamped - static_cast<double>(finer);
  const SquarePoint at = square_from_direction(direction);
  const glm::dvec3 value = look_up_bilinear(chain[finer], at);
  if (between == 0.0) return Rgb(value);
  return Rgb((1.0 - between) * value + between * look_up_bilinear(chain[finer + 1], at));
}

}  // namespace lightproof
