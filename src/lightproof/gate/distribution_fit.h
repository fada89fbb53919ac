// How well a distribution over the texels explains what was drawn.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/gate/draws.h"
#include "lightproof/gate/test_case.h"
#include "lightproof/image/target_density.h"

namespace lightproof {

/// A distribution that fits better than this at its worst is not rejected by the samples: the
/// probability that a diagnosis withholds the right distribution.
inline constexpr double kFitLevel = 1e-3;

/// How many times likelier the samples must be under a distribution than under any other one that
/// is known, the declared one among them, before it is named. That a wrong one of two simple
/// distributions is so much likelier has a probability below one over this (Markov), with thirty
/// others below 30 over it.
inline constexpr double kNamingOdds = 1e4;

/// The distribution that the samples make likeliest.
struct DistributionFit {
  std::string_view distribution;  ///< empty: none is likelier than the declared one
  double log10_odds = 0.0;        ///< against the next, the declared distribution among them
  std::string_view next;          ///< empty: the declared one
  double log10_p = 0.0;           ///< log10_fit() of this distribution
  /// Whether it is likelier than the next one by kNamingOdds, and not rejected at kFitLevel.
  bool named() const;
};

/// What separates one sampler under test from the alternatives of its test case.
struct DistributionScores {
  /// The logarithm of how many times likelier the drawn counts are under each alternative than as
  /// declared.
  std::vector<double> gains;
  /// The sum over kGateBins of how far each alternative's masses are from those of the sampler's
  /// own pdf; NaN if that does not integrate.
  std::vector<double> from_own_pdf;
};

/// What is scored: what one sampler drew, and the masses of kGateBins by its own pdf.
struct Scored {
  const Draws* draws;
  const Grid<double>* own_bins;
};

/// Runs body(0) … body(count-1), each of which holds some grids of the map's size: in parallel, or
/// one after the other on a map so large that one for each thread might not fit.
void for_each_holding_grids(std::size_t count, const Expectation& expectation,
                            const std::function<void(std::size_t)>& body);

/// The scores of several samplers of one test case. The masses of every alternative are computed
/// once, whatever their number, and not kept. The number of threads changes no bit.
std::vector<DistributionScores> score_distributions(std::span<const Alternative> alternatives,
                                                    const Expectation& expectation,
                                                    std::span<const Scored> scored);

/// The sum over all cells of the absolute differences of two grids of one extent.
double distance(const Grid<double>& a, const Grid<double>& b);

/// The distribution that the samples make likeliest, by the scores of their sampler.
DistributionFit likeliest_distribution(std::span<const Alternative> alternatives,
                                       const DistributionScores& scores, const Draws& draws);

/// log10 of how well probabilities of texels fit their counts among `samples` samples: the smallest
/// p-value of goodness of fit over blocks of texels, texels, rows, columns and the worst texel,
/// times their number. Where in their texels samples lie makes no difference.
double log10_fit_of_counts(const Grid<std::uint64_t>& texels, const Grid<double>& masses,
                           std::uint64_t samples);

/// log10_fit_of_counts() of the texels of what was drawn on the map.
double log10_fit(const Draws& draws, const Grid<double>& masses);

}  // namespace lightproof
