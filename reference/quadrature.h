// Integrals over the sphere of functions that are smooth inside a texel: 3 x 3 Gauss-Legendre nodes
// in (phi, theta) for every texel, or its middle alone; texels that straddle an edge of the
// integrand are halved until they are small.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"

namespace lightproof::reference {

/// A direction at which an integrand over the sphere is evaluated.
struct Node {
  Direction direction;
  /// d(omega)/(ds dt) over 2 pi^2, which in latitude and longitude is sin(theta).
  double sin_theta;
  double solid_angle;  ///< weight of the node in steradian
  SquarePoint at;      ///< the direction's position in the square
};

/// Which nodes a cell has. The middle alone takes a ninth of the time of Gauss's nodes, and is off
/// by h^2/24 times the second derivative of the integrand, for cells of side h in radians.
enum class CellRule {
  gauss,     ///< 3 x 3 Gauss-Legendre nodes
  adaptive,  ///< the middle of cells about which the integrand varies little far beyond their
             ///< borders
  midpoint,  ///< the middle of all that no edge crosses
};

/// The nodes of one cell.
enum class CellNodes {
  middle,  ///< one
  gauss,   ///< 3 x 3
};

/// A cell: a texel, or what it is divided into.
struct QuadratureCell {
  int x;      ///< column, of cells of this depth
  int y;      ///< row, of cells of this depth
  int depth;  ///< how often the texel was halved
};

/// Cells of one row that follow each other, and what lies around them.
struct CellRun {
  int begin;         ///< first column
  int end;           ///< one past the last
  Direction centre;  ///< the middle of the run
  double radius;     ///< largest angle between the middle and a point of the run, in radians
};

/// A quadrature over the sphere by nodes in the texels of a map of one extent. The weights of a
/// texel's nodes sum to its exact solid angle.
class SphereQuadrature {
 public:
  /// With at least so many cells the rule's error is below 1e-9 of an integrand as smooth as a
  /// cosine.
  static constexpr Extent kLeastCells = {256, 128};
  /// Cells that an edge of the integrand may cross are halved until the whole sphere would have
  /// this many or more.
  static constexpr Extent kLeastEdgeCells = {4096, 2048};

  /// How many cells a texel of a map must be divided into so that the sphere has kLeastCells.
  static Extent cells_per_texel(Extent map) {
    return {(kLeastCells.width + map.width - 1) / map.width,
            (kLeastCells.height + map.height - 1) / map.height};
  }

  explicit SphereQuadrature(Extent extent);

  Extent extent() const { return extent_; }
  /// The depth of the smallest cells: in those an edge may be left.
  int depth() const { return static_cast<int>(levels_.size()) - 1; }
  /// Direction of the centre of a cell.
  Direction centre(const QuadratureCell& cell) const {
    const Nodes& middles = level_of(cell).nodes[static_cast<std::size_t>(CellNodes::middle)];
    const Row& row = middles.rows[static_cast<std::size_t>(cell.y)];
    const Column& column = middles.columns[static_cast<std::size_t>(cell.x)];
    return {row.sine * column.cosine, row.sine * column.sine, row.cosine};
  }
  /// Largest angle between the centre of a cell of this depth and a point of it, in radians.
  double radius(int depth) const { return levels_[static_cast<std::size_t>(depth)].radius; }

  /// Calls visit(QuadratureCell) for the parts of a cell: halves of its sides, of those that are
  /// longer than the smallest cells'.
  template <class Visit>
  void visit_parts(const QuadratureCell& cell, const Visit& visit) const {
    const Extent whole = level_of(cell).cells;
    const int depth = cell.depth + 1;
    const Extent divided = levels_[static_cast<std::size_t>(depth)].cells;
    const Extent parts = {divided.width / whole.width, divided.height / whole.height};
    for (int y = cell.y * parts.height; y < (cell.y + 1) * parts.height; ++y) {
      for (int x = cell.x * parts.width; x < (cell.x + 1) * parts.width; ++x) {
        visit(QuadratureCell{x, y, depth});
      }
    }
  }

  /// How many runs a row has, and the one of this index in row y.
  int runs() const { return static_cast<int>(run_columns_.size()); }
  CellRun run(int index, int y) const {
    const auto [cos_phi, sin_phi] = run_columns_[static_cast<std::size_t>(index)];
    const Row& row = levels_[0]
                         .nodes[static_cast<std::size_t>(CellNodes::middle)]
                         .rows[static_cast<std::size_t>(y)];
    return {index * kRunCells,
            std::min((index + 1) * kRunCells, extent_.width),
            {row.sine * cos_phi, row.sine * sin_phi, row.cosine},
            run_radius_};
  }

  /// Calls visit(Node) for every node of a cell.
  template <class Visit>
  void visit(const QuadratureCell& cell, CellNodes of_cell, const Visit& visit) const {
    const Nodes& nodes = level_of(cell).nodes[static_cast<std::size_t>(of_cell)];
    for (int j = cell.y * nodes.per_side; j < (cell.y + 1) * nodes.per_side; ++j) {
      const Row& row = nodes.rows[static_cast<std::size_t>(j)];
      for (int i = cell.x * nodes.per_side; i < (cell.x + 1) * nodes.per_side; ++i) {
        const Column& column = nodes.columns[static_cast<std::size_t>(i)];
        visit(Node{{row.sine * column.cosine, row.sine * column.sine, row.cosine},
                   row.sine,
                   row.weight * column.weight,
                   {column.s, row.t}});
      }
    }
  }

 private:
  struct Row {
    double sine;
    double cosine;
    double weight;  ///< solid angle of the cell, shared out by the row's nodes
    double t;
  };
  struct Column {
    double cosine;
    double sine;
    double weight;  ///< share of the cell; the shares of a cell's columns sum to 1
    double s;
  };
  /// Nodes of one kind of all cells of one size.
  struct Nodes {
    int per_side;  ///< how many a side of a cell has
    std::vector<Row> rows;
    std::vector<Column> columns;
  };
  /// All cells of one depth.
  struct Level {
    Extent cells;  ///< how many the sphere has
    double radius;
    std::array<Nodes, 2> nodes;  ///< by CellNodes
  };

  static constexpr int kRunCells = 16;

  const Level& level_of(const QuadratureCell& cell) const {
    return levels_[static_cast<std::size_t>(cell.depth)];
  }
  void add_level(Extent cells);
  static Nodes make_nodes(Extent cells, CellNodes of_cell);

  Extent extent_;
  double run_radius_;
  std::vector<Level> levels_;                       ///< by depth
  std::vector<std::array<double, 2>> run_columns_;  ///< cosine and sine of runs' middle phi
};

}  // namespace lightproof::reference
