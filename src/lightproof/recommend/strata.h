// What stratified points leave of a variance: that inside the cells of a grid of the square, found
// by values at many points of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lightproof/core/measure.h"

namespace lightproof {

/// A side of the grid of points at which values are taken.
inline constexpr int kStrataSide = 64;
inline constexpr std::size_t kStrataPoints = std::size_t{kStrataSide} * kStrataSide;
/// Grids of 1, 4, 16, 64 and 256 strata: with fewer than 16 points in each, little would be known.
inline constexpr std::size_t kStrataGrids = 5;

/// The mean variance inside the strata of each grid.
using StrataVariances = std::array<double, kStrataGrids>;

/// The points at which values are taken, row by row in t: one in each cell of the grid, at random;
/// those of a row have one t.
std::vector<SquarePoint> strata_points();

/// The variances of values at these points.
StrataVariances variances_inside(std::span<const double> values);

/// The largest of the grids that has at most so many strata.
std::size_t strata_grid_of(std::uint64_t samples);

}  // namespace lightproof
