// Tables that are smaller than the map: of the means of blocks of texels. The density is that of
// the block, the light that of the texel at the direction; as every block with light has a mass,
// nothing is lost but evenness.
#pragma once

#include <functional>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/estimators/light_samples.h"

namespace lightproof {

/// Integrals over the blocks of an even grid over the map, whose edges may cut texels.
struct BlockSums {
  Grid<double> light;   ///< ∫ L over each block, in the map's luminance times steradian
  Grid<double> square;  ///< ∫ L^2
  std::vector<double> solid_angle;  ///< of a block of each row, in steradian
};

/// The integrals of luminance over this many blocks, at most one a texel along either side.
BlockSums block_sums(const EnvironmentMap& map, Extent blocks);

/// How many blocks a table reduced by this factor has: a side over the factor, rounded up.
Extent reduced_extent(Extent map, int factor);

/// The map's blocks by one alias table, positions in them uniform in solid angle. Throws InputError
/// if the map is black. The factor is at least 1.
PreparedSource reduced_table_source(const EnvironmentMap& map, int factor);

/// The density of such a table, per steradian, at any position in the square of latitude and
/// longitude. 0
/// everywhere for a black map.
std::function<PerSteradian(SquarePoint)> reduced_table_pdf(const EnvironmentMap& map, int factor);

/// What the reduced table adds to the variance of one sample of ∫ L, relative to its square: the
/// sum over blocks of q CV^2, q the block's share of the light, CV the coefficient of variation of
/// L over its solid angle. Of the exact table there is none to begin with. 0 of a black map.
double reduced_table_variance(const EnvironmentMap& map, int factor);

}  // namespace lightproof
