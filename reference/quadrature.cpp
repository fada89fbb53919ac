#include "reference/quadrature.h"

#include <cmath>

#include "lightproof/core/gauss_rule.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof::reference {
namespace {

/// Exact to degree 5: the fourth moment of an integrand that is linear in a texel needs degree 4.
constexpr int kNodeCount = 3;

/// Solid angle between two t per unit of azimuth.
double band(double t_low, double t_high) {
  return 2.0 * sin_theta(0.5 * (t_low + t_high)) * std::sin(0.5 * kPi * (t_high - t_low));
}

/// How often a texel is divided so that the sphere has at least so many cells.
Extent cells_per_texel(Extent map, Extent least) {
  return {(least.width + map.width - 1) / map.width, (least.height + map.height - 1) / map.height};
}

std::vector<GaussNode> nodes_of(CellRule rule) {
  if (rule == CellRule::midpoint) return {{0.5, 1.0}};
  const GaussRule<kNodeCount> gauss;
  return {gauss.nodes().begin(), gauss.nodes().end()};
}

}  // namespace

SphereQuadrature::SphereQuadrature(Extent extent, CellRule rule)
    : extent_(extent),
      radius_(0.5 * std::hypot(2.0 * kPi / extent.width, kPi / extent.height)),
      coarse_(make_level(cells_per_texel(extent, kLeastCells), rule)),
      fine_(make_level(cells_per_texel(extent, kLeastEdgeCells), rule)) {
  for (int x = 0; x < extent.width; ++x) {
    const Direction at_equator = direction_from_square({(x + 0.5) / extent.width, 0.5});
    centre_columns_.push_back({at_equator.x, at_equator.y});
  }
  for (int y = 0; y < extent.height; ++y) {
    const double t = (y + 0.5) / extent.height;
    centre_rows_.push_back({sin_theta(t), direction_from_square({0.5, t}).z});
  }
}

SphereQuadrature::Level SphereQuadrature::make_level(Extent cells, CellRule rule) const {
  const std::vector<GaussNode> nodes = nodes_of(rule);
  const auto count = static_cast<int>(nodes.size());
  Level level{{count * cells.width, count * cells.height}, {}, {}};
  const int rows = extent_.height * cells.height;
  const int columns = extent_.width * cells.width;
  for (int j = 0; j < rows; ++j) {
    // The rule's own sum is rescaled to the exact solid angle of the cell.
    double sum = 0.0;
    for (const GaussNode& node : nodes) sum += node.weight * sin_theta((j + node.at) / rows);
    const double exact =
        band(static_cast<double>(j) / rows, (j + 1.0) / rows) * 2.0 * kPi / columns;
    for (const GaussNode& node : nodes) {
      const double t = (j + node.at) / rows;
      const double sine = sin_theta(t);
      level.rows.push_back({sine, cos_theta(t), exact * node.weight * sine / sum, t});
    }
  }
  for (int i = 0; i < columns; ++i) {
    for (const GaussNode& node : nodes) {
      const double s = (i + node.at) / columns;
      const double phi = kPi - 2.0 * kPi * (i + node.at) / columns;
      level.columns.push_back({std::cos(phi), std::sin(phi), node.weight, s});
    }
  }
  return level;
}

}  // namespace lightproof::reference
