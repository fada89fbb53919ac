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
    : extent_(extent), run_radius_(radius_of(extent, kRunCells, 1)) {
  Extent cells = extent;
  add_level(cells);
  while (cells.width < kLeastEdgeCells.width || cells.height < kLeastEdgeCells.height) {
    if (cells.width < kLeastEdgeCells.width) cells.width *= 2;
    if (cells.height < kLeastEdgeCells.height) cells.height *= 2;
    add_level(cells);
  }
  for (int x = 0; x < extent.width; x += kRunCells) {
    const double middle = 0.5 * (x + std::min(x + kRunCells, extent.width));
    const Direction at_equator = direction_from_square({middle / extent.width, 0.5});
    run_columns_.push_back({at_equator.x, at_equator.y});
  }
}

void SphereQuadrature::add_level(Extent cells) {
  levels_.push_back({cells,
                     radius_of(cells, 1, 1),
                     {make_nodes(cells, CellNodes::middle), make_nodes(cells, CellNodes::gauss)}});
}

SphereQuadrature::Nodes SphereQuadrature::make_nodes(Extent cells, CellNodes of_cell) {
  const std::vector<GaussNode> nodes = nodes_of(of_cell);
  Nodes made{static_cast<int>(nodes.size()), {}, {}};
  for (int j = 0; j < cells.height; ++j) {
    // The rule's own sum is rescaled to the exact solid angle of the cell.
    double sum = 0.0;
    for (const GaussNode& node : nodes)
      sum += node.weight * sin_theta((j + node.at) / cells.height);
    const double exact = band(static_cast<double>(j) / cells.height, (j + 1.0) / cells.height) *
                         2.0 * kPi / cells.width;
    for (const GaussNode& node : nodes) {
      const double t = (j + node.at) / cells.height;
      const double sine = sin_theta(t);
      made.rows.push_back({sine, cos_theta(t), exact * node.weight * sine / sum, t});
    }
  }
  for (int i = 0; i < cells.width; ++i) {
    for (const GaussNode& node : nodes) {
      const double s = (i + node.at) / cells.width;
      const double phi = kPi - 2.0 * kPi * (i + node.at) / cells.width;
      made.columns.push_back({std::cos(phi), std::sin(phi), node.weight, s});
    }
  }
  return made;
}

}  // namespace lightproof::reference
