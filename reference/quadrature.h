// Integrals over the sphere of functions that are smooth inside a texel: 3 x 3 Gauss-Legendre nodes
// in (phi, theta) for every texel, or its middle alone; texels that straddle an edge of the
// integrand are split first.
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
  edge,    ///< 3 x 3 for each of the parts into which cells are split that an edge may cross
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
  /// The sphere is never divided into fewer cells than this, however few texels the map has: the
  /// rule's error is then below 1e-9 of an integrand as smooth as a cosine.
  static constexpr Extent kLeastCells = {256, 128};
  /// The part of the sphere where an edge of the integrand may run is never divided into fewer
  /// cells than if the whole had this many.
  static constexpr Extent kLeastEdgeCells = {4096, 2048};

  explicit SphereQuadrature(Extent extent);

  Extent extent() const { return extent_; }
  /// Direction of the centre of texel (x, y).
  Direction centre(int x, int y) const {
    const auto [cos_phi, sin_phi] = centre_columns_[static_cast<std::size_t>(x)];
    const auto [sine, cosine] = centre_rows_[static_cast<std::size_t>(y)];
    return {sine * cos_phi, sine * sin_phi, cosine};
  }
  /// Largest angle between the centre of a texel and a point of it, in radians.
  double radius() const { return radius_; }

  /// How many runs a row has, and the one of this index in row y.
  int runs() const { return static_cast<int>(run_columns_.size()); }
  CellRun run(int index, int y) const {
    const auto [cos_phi, sin_phi] = run_columns_[static_cast<std::size_t>(index)];
    const auto [sine, cosine] = centre_rows_[static_cast<std::size_t>(y)];
    return {index * kRunCells,
            std::min((index + 1) * kRunCells, extent_.width),
            {sine * cos_phi, sine * sin_phi, cosine},
            run_radius_};
  }

  /// Calls visit(Node) for every node of texel (x, y).
  template <class Visit>
  void visit(int x, int y, CellNodes nodes, const Visit& visit) const {
    const Level& level = levels_[static_cast<std::size_t>(nodes)];
    for (int j = 0; j < level.nodes.height; ++j) {
      const Row& row = level.rows[static_cast<std::size_t>(y * level.nodes.height + j)];
      for (int i = 0; i < level.nodes.width; ++i) {
        const Column& column = level.columns[static_cast<std::size_t>(x * level.nodes.width + i)];
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
  struct Level {
    Extent nodes;  ///< how many nodes a texel has
    std::vector<Row> rows;
    std::vector<Column> columns;
  };

  static constexpr int kRunCells = 16;

  Level make_level(Extent cells_per_texel, CellNodes nodes) const;

  Extent extent_;
  double radius_;
  double run_radius_;
  std::array<Level, 3> levels_;                        ///< by CellNodes
  std::vector<std::array<double, 2>> centre_columns_;  ///< cosine and sine of phi
  std::vector<std::array<double, 2>> run_columns_;     ///< of the middles of runs
  std::vector<std::array<double, 2>> centre_rows_;     ///< sine and cosine of theta
};

}  // namespace lightproof::reference
