// Exact probabilities of a target density, straight from the image, in double.
#pragma once

#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/image/target_density.h"

namespace lightproof::reference {

/// Probability of every texel; they sum to 1. Throws InputError if the map is black.
Grid<double> texel_masses(const EnvironmentMap& map, TargetDensity target);

/// Probability of every bin of a `bins` grid laid over the same square, from the exact overlap of
/// texels and bins: linear in s; linear in t under A, in cos(theta) under B.
Grid<double> bin_masses(const Grid<double>& texel_masses, DensitySpace density_space, Extent bins);

/// The same of a map's own target density, whatever its look-up. Throws InputError if the map is
/// black.
Grid<double> bin_masses(const EnvironmentMap& map, TargetDensity target, Extent bins);

/// Sums over columns: the marginal of the rows. And over rows.
std::vector<double> row_marginal(const Grid<double>& masses);
std::vector<double> column_marginal(const Grid<double>& masses);

}  // namespace lightproof::reference
