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

std::vector<GaussNode> nodes_of(CellNodes nodes) {
  if (nodes == CellNodes::middle) return {{0.5, 1.0}};
  const GaussRule<kNodeCount> gauss;
  return {gauss.nodes().begin(), gauss.nodes().end()};
}

/// Largest angle between the middle of a rectangle of so many cells and a point of it.
double radius_of(Extent map, int columns, int rows) {
  return 0.5 * std::hypot(2.0 * kPi * columns / map.width, kPi * rows / map.height);
}

}  // namespace

SphereQuadrature::SphereQuadrature(Extent extent)
    : extent_(extent),
      radius_(radius_of(extent, 1, 1)),
      run_radius_(radius_of(extent, kRunCells, 1)),
      levels_{make_level(cells_per_texel(extent, kLeastCells), CellNodes::middle),
              make_level(cells_per_texel(extent, kLeastCells), CellNodes::gauss),
              make_level(cells_per_texel(extent, kLeastEdgeCells), CellNodes::edge)} {
  const auto column_at = [&](double x) -> std::array<double, 2> {
    const Direction at_equator = direction_from_square({x / extent.width, 0.5});
    return {at_equator.x, at_equator.y};
  };
  for (int x = 0; x < extent.width; ++x) centre_columns_.push_back(column_at(x + 0.5));
  for (int x = 0; x < extent.width; x += kRunCells) {
    run_columns_.push_back(column_at(0.5 * (x + std::min(x + kRunCells, extent.width))));
  }
  for (int y = 0; y < extent.height; ++y) {
    const double t = (y + 0.5) / extent.height;
    centre_rows_.push_back({sin_theta(t), direction_from_square({0.5, t}).z});
  }
}

SphereQuadrature::Level SphereQuadrature::make_level(Extent cells, CellNodes of_cell) const {
  const std::vector<GaussNode> nodes = nodes_of(of_cell);
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
