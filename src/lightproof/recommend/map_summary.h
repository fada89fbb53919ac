// A map in a pass: its figures, its harmonics of low degree, and cells of light against which any
// function of direction and luminance is integrated in a few microseconds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/estimators/median_cut.h"
#include "lightproof/image/environment_map.h"

namespace lightproof {

/// Densities over directions that are known texel by texel: what is summed for each is the integral
/// of L^2 / p, so that E[X^2] of its one-sample estimator is the sum of that times k^2.
enum class TableDensity {
  texture_space,  ///< environment A
  sine_weighted,  ///< environment C
  half,           ///< means of blocks of 2 x 2 texels
  quarter,        ///< of 4 x 4
  eighth,         ///< of 8 x 8
  sixteenth,      ///< of 16 x 16
};
inline constexpr std::size_t kTableDensities = 6;
/// Factors by which tables are reduced, from TableDensity::half on.
inline constexpr std::array<int, 4> kReductions = {2, 4, 8, 16};

/// Light of one octave of luminance in one block each; all of one size, block by block, the
/// faintest octave first, before it what is dark of the block. Octaves are those of the mean over
/// the sphere, so that its half and itself, which MIS compensation takes off, are edges of them.
struct LightCells {
  std::vector<double>
      x;  ///< unit vector: the mean direction of the cell's light, of a dark one of itself
  std::vector<double> y;
  std::vector<double> z;
  std::vector<double> solid_angle;
  std::vector<double> light;                                ///< ∫ L over the cell
  std::vector<double> square;                               ///< ∫ L^2
  std::array<std::vector<double>, kTableDensities> second;  ///< ∫ L^2 / p, by TableDensity
  std::vector<std::int8_t> octave;      ///< the brightest one of those that were joined
  std::vector<std::uint16_t> product;   ///< block of "product two-level"
  std::vector<std::uint16_t> quadrant;  ///< square of "product hierarchical"

  std::size_t size() const { return light.size(); }
};

/// A block of the map: some texels of the summary's finest grid, and its cells.
struct LightBlock {
  Direction centre;
  double width;  ///< its longer side, in radians
  int x0, x1;    ///< columns
  int y0, y1;    ///< rows
  std::size_t first_cell;
  std::size_t end_cell;
};

/// Which block of some larger ones a column and a row of the finest grid lie in.
struct BlockIndex {
  std::vector<std::uint16_t> column;
  std::vector<std::uint16_t> row;
  int columns = 0;  ///< how many columns of blocks there are

  std::uint16_t of(int x, int y) const {
    return static_cast<std::uint16_t>(row[static_cast<std::size_t>(y)] * columns +
                                      column[static_cast<std::size_t>(x)]);
  }
};

/// A map as predictions see it; all in luminance by the map's own weights.
struct MapSummary {
  static constexpr Extent kMostBlocks = {128, 64};
  static constexpr Extent kFinest = {1024, 512};
  static constexpr int kDegree = 8;
  /// Numbers of cuts of the median cuts that are kept, for 16, 64, 256 and 1024 lights.
  static constexpr std::array<int, 4> kCuts = {4, 6, 8, 10};

  Extent extent;                    ///< of the map
  LuminanceWeights weights;         ///< of the map
  double light = 0.0;               ///< G = ∫ L d(omega)
  double square = 0.0;              ///< Q = ∫ L^2 d(omega)
  double square_mean = 0.0;         ///< mean of L over (s,t)
  double effective_fraction = 0.0;  ///< G^2 / (4 pi Q): the share of the sphere that light fills
  /// (sum of m)^2 / (sum of m^2) over the masses m of texels: as many equal ones would be as
  /// uneven.
  double effective_texels = 0.0;
  double entropy = 0.0;        ///< of the masses of texels, in bits
  double max_over_mean = 0.0;  ///< the brightest texel over the mean over the sphere
  /// ∫ of what stands above half of the mean, and above the mean.
  double light_above_half = 0.0;
  double light_above_mean = 0.0;
  /// ∫ L Y(l,m), at l (l + 1) + m, up to kDegree.
  std::vector<double> harmonics;
  /// What reduced tables (kReductions) and those of half floats and of bytes add to the relative
  /// variance of ∫ L.
  std::array<double, kReductions.size()> reduced_variance = {};
  double half_float_variance = 0.0;
  double byte_variance = 0.0;

  LightCells cells;
  std::vector<LightBlock> blocks;
  /// The map at kFinest at the most: the mean of L of each texel, and of L^2 if it was made
  /// smaller.
  Grid<float> finest;
  Grid<float> finest_square;
  BlockIndex product_index;    ///< the blocks of "product two-level"
  Grid<double> product_light;  ///< ∫ L of them
  BlockIndex quadrant_index;   ///< the squares of "product hierarchical" at which k is taken
  double quadrant_side = 0.0;  ///< of these, in texels of the map
  /// ∫ L of its squares and their solid angles, level by level from the whole map down to these.
  std::vector<Grid<double>> quadtree_light;
  std::vector<Grid<double>> quadtree_area;
  std::array<std::vector<DirectedLight>, kCuts.size()> lights;

  bool has_light() const { return light > 0.0; }
  /// ∫ of what stands above so many times the mean over the sphere, from 0 on: exact of 0, 1/2 and
  /// 1, else of the means of the finest grid's texels.
  double light_above(double of_mean) const;
  /// Sum over m of |L_lm|^2.
  double power(int degree) const;
};

/// The summary of a map; the same bits whatever the number of threads.
MapSummary summarise(const EnvironmentMap& map);

}  // namespace lightproof
