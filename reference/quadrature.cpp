#include "reference/quadrature.h"

#include <cmath>

#include "lightproof/warp/lat_long.h"

namespace lightproof::reference {
namespace {

/// Gauss-Legendre nodes in [0,1] and their weights (Abramowitz & Stegun 25.4.29, n = 3). Exact to
/// degree 5: the fourth moment of an integrand that is linear in a texel needs degree 4.
struct GaussNode {
  double place;
  double weight;
};
constexpr std::array<GaussNode, 3> kNodes = {
    {{0.11270166537925831, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.88729833462074169, 5.0 / 18.0}}};
constexpr int kNodeCount = static_cast<int>(kNodes.size());

/// Solid angle between two t per unit of azimuth.
double band(double t_low, double t_high) {
  return 2.0 * sin_theta(0.5 * (t_low + t_high)) * std::sin(0.5 * kPi * (t_high - t_low));
}

/// How often a texel is divided so that the sphere has at least so many cells.
Extent cells_per_texel(Extent map, Extent least) {
  return {(least.width + map.width - 1) / map.width, (least.height + map.height - 1) / map.height};
}

}  // namespace

SphereQuadrature::SphereQuadrature(Extent extent)
    : extent_(extent),
      radius_(0.5 * std::hypot(2.0 * kPi / extent.width, kPi / extent.height)),
      coarse_(make_level(cells_per_texel(extent, kLeastCells))),
      fine_(make_level(cells_per_texel(extent, kLeastEdgeCells))) {}

Direction SphereQuadrature::centre(int x, int y) const {
  return direction_from_square({(x + 0.5) / extent_.width, (y + 0.5) / extent_.height});
}

SphereQuadrature::Level SphereQuadrature::make_level(Extent cells) const {
  Level level{{kNodeCount * cells.width, kNodeCount * cells.height}, {}, {}};
  const int rows = extent_.height * cells.height;
  const int columns = extent_.width * cells.width;
  for (int j = 0; j < rows; ++j) {
    // The rule's own sum is rescaled to the exact solid angle of the cell.
    double rule = 0.0;
    for (const GaussNode& node : kNodes) rule += node.weight * sin_theta((j + node.place) / rows);
    const double exact =
        band(static_cast<double>(j) / rows, (j + 1.0) / rows) * 2.0 * kPi / columns;
    for (const GaussNode& node : kNodes) {
      const double t = (j + node.place) / rows;
      const double sine = sin_theta(t);
      level.rows.push_back({sine, cos_theta(t), exact * node.weight * sine / rule, t});
    }
  }
  for (int i = 0; i < columns; ++i) {
    for (const GaussNode& node : kNodes) {
      const double s = (i + node.place) / columns;
      const double phi = kPi - 2.0 * kPi * (i + node.place) / columns;
      level.columns.push_back({std::cos(phi), std::sin(phi), node.weight, s});
    }
  }
  return level;
}

}  // namespace lightproof::reference
