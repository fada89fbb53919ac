#include "lightproof/gate/random_number_defects.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "lightproof/gate/distribution_fit.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

/// Counts nearer to their expectation than this are no chance.
constexpr double kUnderdispersedLevel = 1e-6;

double chi_square_log10_p(double statistic, double dof) {
  const double upper = log10_chi_square_tail(statistic, dof);
  const double lower = log10_chi_square_lower(statistic, dof);
  return std::min(0.0, std::min(upper, lower) + std::log10(2.0));
}

GoodnessOfFit fit_of_bins(const Expectation& expectation, const Draws& draws) {
  return cressie_read(draws.bins, expectation.bins, draws.samples);
}

/// Whether nearly all samples lie at one position inside their texels: a lattice that has nothing
/// to do with the random numbers.
bool is_one_position(const Draws& draws) {
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(draws.positions.extent().width));
  for (int band = 0; band < draws.positions.extent().height; ++band) {
    const auto row = draws.positions.row(band);
    std::transform(row.begin(), row.end(), counts.begin(), counts.begin(), std::plus<>());
  }
  const std::uint64_t all = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  const std::uint64_t most = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
  return 1000 * (all - most) < all;
}

/// Whether one of the transformed coordinates has few values: half of the samples lie on a lattice
/// where one in 128 should.
bool is_coarse(const Draws& draws) {
  return 2 * std::max(draws.marginal_on_lattice, draws.conditional_on_lattice) > draws.samples &&
         !is_one_position(draws);
}

/// One coordinate follows from the other: in every row of the pairs' table all but a thousandth of
/// the samples, for what rounding moves to another cell, lie in two neighbouring cells, in whatever
/// columns, while both coordinates take all values.
bool is_one_number(const Draws& draws) {
  std::uint64_t together = 0;
  std::vector<std::uint64_t> columns(static_cast<std::size_t>(kPairBins.width));
  std::uint64_t emptiest_row = draws.samples;
  for (int y = 0; y < kPairBins.height; ++y) {
    const auto row = draws.pairs.row(y);
    std::transform(row.begin(), row.end(), columns.begin(), columns.begin(), std::plus<>());
    emptiest_row =
        std::min(emptiest_row, std::accumulate(row.begin(), row.end(), std::uint64_t{0}));
    std::uint64_t most = 0;
    for (std::size_t x = 0; x < row.size(); ++x) {
      most = std::max(most, row[x] + row[(x + 1) % row.size()]);
    }
    together += most;
  }
  const std::uint64_t emptiest = *std::min_element(columns.begin(), columns.end());
  const bool spread = std::min(emptiest, emptiest_row) > 0;
  return spread && 1000 * (draws.samples - together) < draws.samples;
}

/// Every number used m times in a row, m being what the share of repeated positions says: counts
/// then scatter m times as much, over the map and inside its cells alike.
bool is_repeated(const Expectation& expectation, const Draws& draws) {
  if (1000 * draws.repeats < draws.samples) return false;
  const double times =
      static_cast<double>(draws.samples) /
      static_cast<double>(std::max<std::uint64_t>(1, draws.samples - draws.repeats));
  const GoodnessOfFit bins = fit_of_bins(expectation, draws);
  const std::vector<double> even(kPairBins.count(), 1.0 / static_cast<double>(kPairBins.count()));
  const GoodnessOfFit pairs = cressie_read(serpentine(draws.pairs), even, draws.samples);
  const bool pairs_fit =
      !expectation.transform || pairs.dof <= 0.0 ||
      chi_square_log10_p(pairs.statistic / times, pairs.dof) > std::log10(0.5 * kFitLevel);
  const double level = std::log10(0.5 * kFitLevel);
  return (bins.dof <= 0.0 || chi_square_log10_p(bins.statistic / times, bins.dof) > level) &&
         pairs_fit;
}

bool is_stratified(const Expectation& expectation, const Draws& draws) {
  const std::vector<double> even(kPairBins.count(), 1.0 / static_cast<double>(kPairBins.count()));
  const GoodnessOfFit bins = fit_of_bins(expectation, draws);
  const GoodnessOfFit pairs = cressie_read(serpentine(draws.pairs), even, draws.samples);
  const auto underdispersed = [](const GoodnessOfFit& fit) {
    return fit.dof > 0.0 &&
           log10_chi_square_lower(fit.statistic, fit.dof) < std::log10(kUnderdispersedLevel);
  };
  return underdispersed(bins) || underdispersed(pairs);
}

}  // namespace

std::string_view name_of_number_defect(const Expectation& expectation, const Draws& draws) {
  if (is_coarse(draws)) return "coarse-numbers";
  if (is_stratified(expectation, draws)) return "stratified";
  if (expectation.transform && is_one_number(draws)) return "same-number";
  if (is_repeated(expectation, draws)) return "repeated-numbers";
  return {};
}

}  // namespace lightproof
