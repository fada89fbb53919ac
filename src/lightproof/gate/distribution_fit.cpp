#include "lightproof/gate/distribution_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "lightproof/core/parallel.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

constexpr double kImpossible = 1e-300;

/// The logarithm of how many times likelier one sample in each texel is under `distribution`.
Grid<double> log_ratios(const Grid<double>& distribution, const Grid<double>& declared) {
  Grid<double> ratios(distribution.extent());
  for (std::size_t i = 0; i < distribution.values().size(); ++i) {
    const double ratio = std::max(distribution.values()[i], kImpossible) /
                         std::max(declared.values()[i], kImpossible);
    ratios.values()[i] = std::log(ratio);
  }
  return ratios;
}

double log_likelihood_gain(const Draws& draws, const Grid<double>& log_ratios) {
  double gain = 0.0;
  for (std::size_t i = 0; i < log_ratios.values().size(); ++i) {
    gain += static_cast<double>(draws.texels.values()[i]) * log_ratios.values()[i];
  }
  return gain;
}

double log10_p(const Grid<std::uint64_t>& counts, const Grid<double>& masses,
               std::uint64_t samples) {
  return cressie_read(counts, masses, samples).log10_p;
}

double log10_p(std::span<const std::uint64_t> counts, std::span<const double> masses,
               std::uint64_t samples) {
  return cressie_read(counts, masses, samples).log10_p;
}

/// Sums over blocks of whole texels, about as many as there are bins. Bins may divide texels, and
/// then say where in them samples lie, too.
template <class Value>
Grid<Value> over_blocks(const Grid<Value>& texels) {
  const auto [width, height] = texels.extent();
  Grid<Value> blocks({std::min(width, kGateBins.width), std::min(height, kGateBins.height)});
  const auto block_of = [](int texel, int all, int parts) {
    return static_cast<int>(static_cast<std::int64_t>(texel) * parts / all);
  };
  for (int y = 0; y < height; ++y) {
    const auto row = blocks.row(block_of(y, height, blocks.extent().height));
    for (int x = 0; x < width; ++x) {
      row[static_cast<std::size_t>(block_of(x, width, blocks.extent().width))] += texels(x, y);
    }
  }
  return blocks;
}

/// The p-values (log10) of goodness of fit of blocks of texels, texels, rows, columns and the worst
/// texel.
std::vector<double> log10_ps(const Grid<std::uint64_t>& texels, const Grid<double>& masses,
                             std::uint64_t samples) {
  return {log10_p(over_blocks(texels), over_blocks(masses), samples),
          log10_p(texels, masses, samples),
          log10_p(row_counts(texels), reference::row_marginal(masses), samples),
          log10_p(column_counts(texels), reference::column_marginal(masses), samples),
          worst_cell(texels.values(), masses.values(), samples).log10_p};
}

/// The least of several p-values, by Bonferroni.
double of_several(std::span<const double> log10_ps) {
  const double least = *std::min_element(log10_ps.begin(), log10_ps.end());
  return std::min(0.0, least + std::log10(static_cast<double>(log10_ps.size())));
}

}  // namespace

bool DistributionFit::named() const {
  return !distribution.empty() && log10_odds >= std::log10(kNamingOdds) &&
         log10_p >= std::log10(kFitLevel);
}

double log10_fit_of_counts(const Grid<std::uint64_t>& texels, const Grid<double>& masses,
                           std::uint64_t samples) {
  const std::vector<double> all = log10_ps(texels, masses, samples);
  return of_several(all);
}

double log10_fit(const Draws& draws, const Grid<double>& masses) {
  return log10_fit_of_counts(draws.texels, masses, draws.samples - draws.out_of_domain.count);
}

double distance(const Grid<double>& a, const Grid<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    sum += std::abs(a.values()[i] - b.values()[i]);
  }
  return sum;
}

void for_each_holding_grids(std::size_t count, const Expectation& expectation,
                            const std::function<void(std::size_t)>& body) {
  /// The texels of a map of 2048 x 1024, beyond which one grid takes more than 16 MiB.
  constexpr std::size_t kMostTexels = std::size_t{1} << 21U;
  if (expectation.masses.values().size() <= kMostTexels) return parallel_for(count, body);
  for (std::size_t i = 0; i < count; ++i) body(i);
}

std::vector<DistributionScores> score_distributions(std::span<const Alternative> alternatives,
                                                    const Expectation& expectation,
                                                    std::span<const Scored> scored) {
  const std::vector<double> none(alternatives.size());
  std::vector<DistributionScores> scores(scored.size(), DistributionScores{none, none});
  for_each_holding_grids(alternatives.size(), expectation, [&](std::size_t distribution) {
    const Grid<double> masses = alternatives[distribution].masses();
    const Grid<double> ratios = log_ratios(masses, expectation.masses);
    const Grid<double> bins = expectation.bins_of(masses);
    for (std::size_t i = 0; i < scored.size(); ++i) {
      scores[i].gains[distribution] = log_likelihood_gain(*scored[i].draws, ratios);
      scores[i].from_own_pdf[distribution] = distance(bins, *scored[i].own_bins);
    }
  });
  return scores;
}

DistributionFit likeliest_distribution(std::span<const Alternative> alternatives,
                                       const DistributionScores& scores, const Draws& draws) {
  DistributionFit best;
  const Alternative* best_distribution = nullptr;
  double most = 0.0;  // of the declared distribution
  double second = -INFINITY;
  for (std::size_t i = 0; i < alternatives.size(); ++i) {
    const Alternative& distribution = alternatives[i];
    const double gain = scores.gains[i];
    // Distributions that are one and the same on this map count once, by the first name.
    if (std::abs(gain - most) <= 1e-9 * std::abs(most)) continue;
    if (gain > most) {
      second = most;
      best.next = best.distribution;
      most = gain;
      best.distribution = distribution.name;
      best_distribution = &distribution;
    } else if (gain > second) {
      second = gain;
      best.next = distribution.name;
    }
  }
  if (best_distribution == nullptr) return best;
  best.log10_odds = (most - second) * std::numbers::log10e;
  best.log10_p = log10_fit(draws, best_distribution->masses());
  return best;
}

}  // namespace lightproof
