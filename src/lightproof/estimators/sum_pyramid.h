// Sums of a grid's cells over ever larger squares: the quadtree of hierarchical products, and of
// what predicts them.
#pragma once

#include <vector>

#include "lightproof/core/grid.h"

namespace lightproof {

/// Grids from one cell down; each cell has up to 2 x 2 in the next one.
using SumPyramid = std::vector<Grid<double>>;

/// The grid whose cells are the sums of 2 x 2 cells, fewer at the edges.
Grid<double> sums_of_quarters(const Grid<double>& cells);

/// All such grids above this one, and it.
SumPyramid sum_pyramid(Grid<double> cells);

}  // namespace lightproof
