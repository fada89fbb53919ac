// Goodness of fit of counts to exact expectations.
//
// The power divergence of Cressie and Read (1984) with lambda = 2/3, on cells pooled to an
// expectation of at least 25: at strict levels its size is right where Pearson's is several times
// too large. Nothing is dropped: neighbouring cells are pooled, and a remainder joins the last
// pool. Cells of zero expectation are not part of the sum; a single hit in one is a rejection.
// Counts that agree too well are as unlikely as those that do not (stratified
// points passed off as independent ones), so from 30 degrees of freedom on the p-value is
// two-sided.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lightproof/core/grid.h"

namespace lightproof {

/// The expectation up to which cells are pooled, in samples.
inline constexpr double kPooledExpectation = 25.0;

/// The outcome of a test of counts against their expectations.
struct GoodnessOfFit {
  double statistic = 0.0;
  double dof = 0.0;                ///< pools - 1; 0 means that nothing can be said
  double log10_p = 0.0;            ///< two-sided from 30 dof on; -infinity for impossible hits
  bool underdispersed = false;     ///< nearer to the expectation than to the bulk of chance
  double effect = 0.0;             ///< Cohen's w = sqrt(sum (q-p)^2/p), less what noise alone gives
  std::size_t possible_cells = 0;  ///< cells of positive expectation
  std::uint64_t impossible_hits = 0;
  std::optional<std::size_t> first_impossible;  ///< index of the first impossible cell hit
};

/// A cell's share of the statistic, never negative: 2/(λ(λ+1)) O((O/E)^λ − 1) for λ = 2/3, plus
/// 2/(λ+1) (E − O), which vanishes where ΣO = ΣE. `expected` is positive.
double power_divergence(double observed, double expected);

/// Sets the p-value of a statistic from its degrees of freedom, if it has any.
void judge_fit(GoodnessOfFit& fit);

/// The power divergence of counts over cells from their probabilities, in an order in which
/// neighbours in the sequence are neighbours in space. The probabilities sum to 1 within 1e-9;
/// `samples` of which some are in no cell are the caller's to judge.
GoodnessOfFit cressie_read(std::span<const std::uint64_t> observed,
                           std::span<const double> probability, std::uint64_t samples);

/// Whether two samples are of one distribution, whatever it is: the same divergence of both from
/// their common shares, on cells pooled until each sample expects 25. `impossible_hits` stays 0.
GoodnessOfFit two_sample_fit(std::span<const std::uint64_t> first,
                             std::span<const std::uint64_t> second);

/// The cell that is farthest from its expectation.
struct WorstCell {
  std::size_t cells = 0;   ///< how many cells have a positive expectation
  double likeliest = 0.0;  ///< largest probability of a cell
  std::size_t cell = 0;    ///< index of the worst cell
  double observed = 0.0;   ///< its count
  double expected = 0.0;   ///< its expectation
  double log10_p = 0.0;    ///< log10 P(any cell is as far off as this), by Bonferroni's bound
};

/// The Poisson tail (for counts of a fixed total it is a bound) of the cell with the largest
/// deviance, however small its expectation: what is never drawn, or one place that is wrong, shows
/// here long before it moves a sum over all cells.
WorstCell worst_cell(std::span<const std::uint64_t> observed, std::span<const double> probability,
                     std::uint64_t samples);

/// The effect w that cressie_read with these degrees of freedom finds with `power` at this level.
double minimum_detectable_w(double dof, double level, double power, double samples);

/// How often cressie_read of this size rejects samples of the distribution `actual`: a non-central
/// chi-square whose non-centrality is the divergence of the expectations.
double fit_power(std::span<const double> probability, std::span<const double> actual, double level,
                 std::uint64_t samples);

/// The fewest counts whose upper Poisson tail at this mean is at most `level`, which is below 1/2.
double critical_count(double mean, double level);

/// The relative excess of the likeliest cell that the test of worst_cell() finds with at least
/// `power` at this level: the Poisson critical count of Bonferroni's share of the level, and the
/// mean at which that count is reached with this power. Infinite if the cell would need more than
/// all samples.
double minimum_detectable_excess(const WorstCell& worst, double level, double power,
                                 double samples);

/// cressie_read() of counts over the cells of a grid, in the order of serpentine(); no copy of
/// either is made.
GoodnessOfFit cressie_read(const Grid<std::uint64_t>& observed, const Grid<double>& probability,
                           std::uint64_t samples);

/// The values of a grid row by row, every second row backwards, so that consecutive cells touch.
template <class T>
std::vector<T> serpentine(const Grid<T>& grid) {
  std::vector<T> sequence;
  sequence.reserve(grid.extent().count());
  for (int y = 0; y < grid.extent().height; ++y) {
    const auto row = grid.row(y);
    if (y % 2 == 0) {
      sequence.insert(sequence.end(), row.begin(), row.end());
    } else {
      sequence.insert(sequence.end(), row.rbegin(), row.rend());
    }
  }
  return sequence;
}

}  // namespace lightproof
