#include "lightproof/estimators/hierarchical_product.h"

#include <algorithm>

#include "lightproof/estimators/sum_pyramid.h"
#include "lightproof/estimators/tabulated_source.h"
#include "lightproof/estimators/texel_directions.h"
#include "lightproof/samplers/texel_positions.h"
#include "lightproof/samplers/texel_weights.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr Extent kMostSquares = HierarchicalProduct::kMostSquares;
constexpr double kDefensiveShare = HierarchicalProduct::kDefensiveShare;

/// The solid angles of texels.
Grid<double> solid_angles(Extent extent) {
  Grid<double> areas(extent);
  for (int y = 0; y < extent.height; ++y) {
    std::ranges::fill(areas.row(y), texel_solid_angle(extent, y));
  }
  return areas;
}

/// A cell's four quarters, and which one a number chose.
struct Choice {
  int chosen;
  double share;
  double rest;
};
Choice choose(double u, double low, double high) {
  const double share = low / (low + high);
  if (u < share) return {0, share, std::min(u / share, 1.0 - 0x1p-53)};
  return {1, 1.0 - share, std::min((u - share) / (1.0 - share), 1.0 - 0x1p-53)};
}

/// The map's quadtree.
class Quadtree {
 public:
  explicit Quadtree(const EnvironmentMap& map)
      : light_(sum_pyramid(texel_weights(map, on_map({DensitySpace::solid_angle}, map)))),
        area_(sum_pyramid(solid_angles(map.radiance.extent()))),
        positions_(map.radiance.extent(), DensitySpace::solid_angle),
        squares_(level_of_squares()),
        centres_(square_size(), 0.5, light_[squares_].extent()) {}

  std::size_t bytes() const {
    std::size_t bytes = positions_.bytes() + centres_.bytes();
    for (const Grid<double>& level : light_) bytes += level.values().size_bytes();
    for (std::size_t level = 0; level <= squares_; ++level) {
      bytes += area_[level].values().size_bytes();
    }
    return bytes;
  }

  /// The map's sums times averages of k, for all levels at which k is known.
  SumPyramid table(const Material& material, const ShadingPoint& at) const {
    const Grid<double>& light = light_[squares_];
    Grid<double> k(light.extent());
    for (int y = 0; y < k.extent().height; ++y) centres_.reflected(material, at, y, k.row(y));
    double sum = 0.0;
    for (std::size_t i = 0; i < k.values().size(); ++i) sum += k.values()[i] * light.values()[i];
    const double whole = light_.front().values().front();
    const double least = sum > 0.0 ? kDefensiveShare * sum / whole : 1.0;
    for (std::size_t i = 0; i < k.values().size(); ++i) {
      k.values()[i] = (k.values()[i] + least) * area_[squares_].values()[i];
    }
    SumPyramid product = sum_pyramid(std::move(k));
    for (std::size_t level = 0; level < product.size(); ++level) {
      for (std::size_t i = 0; i < product[level].values().size(); ++i) {
        product[level].values()[i] *= light_[level].values()[i] / area_[level].values()[i];
      }
    }
    return product;
  }

  LightSample sample(const SumPyramid& product, SquarePoint u) const {
    int x = 0;
    int y = 0;
    double mass = 1.0;
    for (std::size_t level = 1; level < light_.size(); ++level) {
      const Grid<double>& weights = level < product.size() ? product[level] : light_[level];
      const Extent extent = weights.extent();
      const auto weight = [&](int right, int up) {
        const bool exists = 2 * x + right < extent.width && 2 * y + up < extent.height;
        return exists ? weights(2 * x + right, 2 * y + up) : 0.0;
      };
      const double quarters[2][2] = {{weight(0, 0), weight(1, 0)}, {weight(0, 1), weight(1, 1)}};
      const Choice row =
          choose(u.t, quarters[0][0] + quarters[0][1], quarters[1][0] + quarters[1][1]);
      const Choice column = choose(u.s, quarters[row.chosen][0], quarters[row.chosen][1]);
      x = 2 * x + column.chosen;
      y = 2 * y + row.chosen;
      u = {column.rest, row.rest};
      mass *= row.share * column.share;
    }
    return positions_.direction({x, y, u.s, u.t, mass});
  }

 private:
  std::size_t level_of_squares() const {
    std::size_t level = light_.size() - 1;
    while (light_[level].extent().width > kMostSquares.width ||
           light_[level].extent().height > kMostSquares.height) {
      --level;
    }
    return level;
  }
  /// Squares reach beyond the map's edges where its sides are no powers of two.
  CellSize square_size() const {
    const double texels = std::ldexp(1.0, static_cast<int>(light_.size() - 1 - squares_));
    const Extent extent = light_.back().extent();
    return {texels / extent.width, texels / extent.height};
  }

  SumPyramid light_;  ///< luminance times solid angle
  SumPyramid area_;   ///< solid angle
  TexelPositions positions_;
  std::size_t squares_;  ///< the level at which k is taken
  TexelDirections centres_;
};

}  // namespace

PreparedSource hierarchical_product_source(const EnvironmentMap& map) {
  return tabulated_source<Quadtree>(map);
}

}  // namespace lightproof
