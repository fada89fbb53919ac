// Exact mean and variance of estimators that combine two densities, that of the material and that
// of the map, by multiple importance sampling: ∫ f = ∫ L k d(omega) by quadrature, as
// estimator_moments.h has it for one density.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "reference/estimator_moments.h"
#include "reference/quadrature.h"

namespace lightproof::reference {

/// How samples of several techniques are weighted (Veach and Guibas 1995).
enum class Heuristic {
  balance,  ///< w_i = n_i p_i / sum of n_j p_j
  power,    ///< w_i = (n_i p_i)^2 / sum of (n_j p_j)^2
};

/// What an estimator does with the densities of the material and of the map, half of its samples
/// each.
struct CombinedSampling {
  /// Whether every sample chooses its density at random: the one-sample estimator, whose variance
  /// is ∫ f^2 / sum of c_i p_i - I^2 under the balance heuristic. Else half of the samples are of
  /// either: the multi-sample estimator, sum of (1/n_i) [∫ w_i^2 f^2 / p_i - (∫ w_i f)^2].
  bool is_one_sample = false;
  Heuristic heuristic = Heuristic::balance;
  /// The share of the mean radiance that is taken off the map before it is drawn from (Karlík et
  /// al. 2019): density over directions proportional to max(0, L - compensation · mean). Of a map
  /// of which less than 1e-6 is left so, nothing is taken off.
  double compensation = 0.0;
};

/// Mean and variance of an estimator, the variance as that of one sample: N times the variance of
/// the mean over an even number N of samples.
struct MeanAndVariance {
  double mean = 0.0;
  double variance = 0.0;
  /// The largest independent estimate at any node, of one sample or, of a multi-sample estimator,
  /// of a pair; between nodes it is a few percent more.
  double largest = 0.0;
  /// The fourth central moment of independent estimates. A pair's variance is half of `variance`.
  double fourth_central = 0.0;
};

/// The moments of one combined estimator, one entry per grid of radiance L, which is constant
/// inside a texel; all grids have one extent.
std::vector<MeanAndVariance> combined_moments(const Kernel& kernel,
                                              std::span<const Grid<double>> radiance,
                                              const CombinedSampling& sampling);

/// The moments of several combined estimators, as [estimator][grid of radiance]; they share the
/// kernel's values, which take most of the time.
std::vector<std::vector<MeanAndVariance>> combined_moments(
    const Kernel& kernel, std::span<const Grid<double>> radiance,
    std::span<const CombinedSampling> samplings, CellRule rule = CellRule::gauss);

/// A density over directions, per steradian, at a node; positive wherever k is.
using DensityAtNode = std::function<double(const Node&)>;

/// The moments of the one-sample estimator of any density over directions.
std::vector<MeanAndVariance> density_moments(const Kernel& kernel,
                                             std::span<const Grid<double>> radiance,
                                             const DensityAtNode& pdf);

/// The moments of combined estimators and of densities, as [estimator][grid of radiance].
struct SamplingMoments {
  std::vector<std::vector<MeanAndVariance>> combined;
  std::vector<std::vector<MeanAndVariance>> densities;
};

/// The moments of combined estimators and of the one-sample estimators of densities, in one pass
/// over the sphere, which shares the kernel's values.
SamplingMoments sampling_moments(const Kernel& kernel, std::span<const Grid<double>> radiance,
                                 std::span<const CombinedSampling> samplings,
                                 std::span<const DensityAtNode> pdfs,
                                 CellRule rule = CellRule::gauss);

}  // namespace lightproof::reference
