// Exact probabilities of a target density, straight from the image, in double.
#pragma once

#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/image/target_density.h"

namespace lightproof::reference {

/// Probability of every texel; they sum to 1. Throws InputError if the map is black.
Grid<double> texel_masses(const EnvironmentMap& map, TargetDensity target);

/// Probability of every bin of a `bins` grid laid over the same square, from the exact overlap of
/// texels and bins: linear in s; in t or in cos(theta) by
/// position_measure() of the density.
Grid<double> bin_masses(const Grid<double>& texel_masses, DensitySpace density_space, Extent bins);

/// Probability of every bin of a `bins` grid over (s,t), of texels with these masses inside of
/// which positions are uniform in solid angle, in columns that are shifted: their s is less than
/// that of the bins by `shift`, from -1 to 1.
Grid<double> turned_bin_masses(const Grid<double>& texel_masses, double shift, Extent bins);

/// Probability of every bin of a `bins` grid laid over (s,t) of Lightproof's own frame, which is to
/// say over (phi, theta), of a map's target density by either look-up; they sum to 1. Exact on maps
/// of latitude and longitude; on others to binned_masses() of mapped_texels.h. Throws InputError if
/// the map is black.
Grid<double> bin_masses(const EnvironmentMap& map, TargetDensity target, Extent bins);

/// Masses of the rows of a grid: the sums over its columns.
std::vector<double> row_marginal(const Grid<double>& masses);
/// Masses of the columns of a grid: the sums over its rows.
std::vector<double> column_marginal(const Grid<double>& masses);

}  // namespace lightproof::reference
