// Trials whose distribution is off by a known effect, in the terms of some test.
#pragma once

#include <span>

#include "lightproof/self_test/trial.h"

namespace lightproof {

/// The effect w of drawing from q on cells that are tested for p: the root of sum (q-p)^2 / p.
double effect_on(std::span<const double> declared, std::span<const double> drawn);

/// How far a distribution is from the declared one, in the terms of some test; in proportion to the
/// share that is mixed in.
using DistributionDistance = double (*)(const Grid<double>& declared, const Grid<double>& drawn);

/// The effect w on the bins over (phi, theta), of masses of texels.
double distance_of_bins(const Grid<double>& declared, const Grid<double>& drawn);
/// The effect w on the texels, of masses of texels.
double distance_of_texels(const Grid<double>& declared, const Grid<double>& drawn);
/// The effect w on the rows, of masses of texels.
double distance_of_rows(const Grid<double>& declared, const Grid<double>& drawn);
/// The effect w on the columns, of masses of texels.
double distance_of_columns(const Grid<double>& declared, const Grid<double>& drawn);
/// Kuiper's distance of the transformed phi, of masses of texels.
double distance_of_phi(const Grid<double>& declared, const Grid<double>& drawn);
/// Anderson and Darling's distance of the transformed theta, of masses of texels.
double distance_of_theta(const Grid<double>& declared, const Grid<double>& drawn);

/// A trial that draws the declared distribution with so much of another one, uniform but for two
/// thirds of it on one side, that it is off by `effect`.
Trial trial_off_by(double effect, DistributionDistance distance);

/// Distances between the distributions of a transformed coordinate that is uniform if `declared` is
/// drawn.
struct TransformedDistance {
  double kuiper = 0.0;    ///< Kuiper's: between the two farthest positions
  double anderson = 0.0;  ///< Anderson and Darling's: root of the weighted mean square
};
/// The distances of a distribution from the declared one, both as masses of ordered cells.
TransformedDistance transformed_distance(std::span<const double> declared,
                                         std::span<const double> actual);

}  // namespace lightproof
