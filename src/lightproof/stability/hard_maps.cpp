#include "lightproof/stability/hard_maps.h"

#include <cmath>
#include <utility>

#include "lightproof/core/random.h"

namespace lightproof::hard_maps {
namespace {

template <class Radiance>
EnvironmentMap made(std::string name, Extent extent, const Radiance& radiance) {
  EnvironmentMap map = {std::move(name), Grid<Rgb>(extent)};
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) map.radiance(x, y) = radiance(x, y);
  }
  return map;
}

}  // namespace

EnvironmentMap constant(Extent extent, float radiance) {
  return made("constant", extent, [&](int, int) { return Rgb(radiance); });
}

EnvironmentMap one_texel(Extent extent, int x, int y, float radiance) {
  return made("one-texel", extent,
              [&](int column, int row) { return Rgb(column == x && row == y ? radiance : 0.0F); });
}

EnvironmentMap lognormal(Extent extent, double sigma, std::uint64_t seed) {
  const RandomStream stream("stability/lognormal", seed);
  return made("lognormal", extent, [&](int x, int y) {
    const auto index = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(extent.width) +
                       static_cast<std::uint64_t>(x);
    const SquarePoint u = stream.point(index);
    // Box and Muller 1958; 1 - u.s is not 0.
    const double normal = std::sqrt(-2.0 * std::log(1.0 - u.s)) * std::cos(2.0 * kPi * u.t);
    return Rgb(static_cast<float>(std::exp(sigma * normal)));
  });
}

EnvironmentMap orientation(Extent extent) {
  return made("orientation", extent, [&](int x, int y) {
    const float right = 2 * x >= extent.width ? 0.25F : 0.0F;
    const float up = 2 * y >= extent.height ? 0.5F : 0.0F;
    const float corner = x == 0 && y == 0 ? 0.25F : 0.0F;
    return Rgb(1.0F + right + up + corner);
  });
}

EnvironmentMap pure_colours(Extent extent) {
  return made("pure-colours", extent, [&](int x, int) {
    Rgb rgb(0.0F);
    rgb[3 * x / extent.width] = 1.0F;
    return rgb;
  });
}

EnvironmentMap scaled(EnvironmentMap map, float factor) {
  for (Rgb& rgb : map.radiance.values()) rgb *= factor;
  return map;
}

EnvironmentMap turned(const EnvironmentMap& map, int columns) {
  EnvironmentMap other = map;
  const Extent extent = map.radiance.extent();
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      other.radiance((x + columns) % extent.width, y) = map.radiance(x, y);
    }
  }
  return other;
}

}  // namespace lightproof::hard_maps
