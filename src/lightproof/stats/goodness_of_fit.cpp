#include "lightproof/stats/goodness_of_fit.h"

#include <algorithm>
#include <boost/math/distributions/poisson.hpp>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "lightproof/core/memo.h"
#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

/// Few counts agree with their expectation exactly now and then; many together do not.
constexpr double kLeastDofForLowerTail = 30.0;

struct Pool {
  double observed = 0.0;
  double expected = 0.0;
};

double cell_divergence(const Pool& pool) { return power_divergence(pool.observed, pool.expected); }

template <class Count>
std::vector<Pool> pool_cells(std::span<const Count> observed, std::span<const double> probability,
                             double samples) {
  std::vector<Pool> pools;
  Pool open;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (probability[i] <= 0.0) continue;
    open.observed += static_cast<double>(observed[i]);
    open.expected += probability[i] * samples;
    if (open.expected < kPooledExpectation) continue;
    pools.push_back(open);
    open = {};
  }
  if (open.expected > 0.0) {
    if (pools.empty()) pools.emplace_back();
    pools.back().observed += open.observed;
    pools.back().expected += open.expected;
  }
  return pools;
}

/// cressie_read() of cells that are added one after the other, whose pools are not kept.
class CressieRead {
 public:
  explicit CressieRead(std::uint64_t samples) : samples_(static_cast<double>(samples)) {}

  void add(std::uint64_t observed, double probability) {
    const std::size_t cell = cells_++;
    if (probability > 0.0) {
      ++fit_.possible_cells;
    } else if (observed > 0) {
      fit_.impossible_hits += observed;
      if (!fit_.first_impossible) fit_.first_impossible = cell;
    }
    if (probability <= 0.0) return;
    open_.observed += static_cast<double>(observed);
    open_.expected += probability * samples_;
    if (open_.expected < kPooledExpectation) return;
    if (pools_ > 0) fit_.statistic += cell_divergence(last_);
    ++pools_;
    last_ = open_;
    open_ = {};
  }

  GoodnessOfFit fit() && {
    if (open_.expected > 0.0) {
      pools_ = std::max<std::size_t>(pools_, 1);
      last_.observed += open_.observed;
      last_.expected += open_.expected;
    }
    if (pools_ > 0) fit_.statistic += cell_divergence(last_);
    fit_.dof = pools_ == 0 ? 0.0 : static_cast<double>(pools_ - 1);
    if (fit_.impossible_hits > 0) {
      fit_.log10_p = -INFINITY;
    } else {
      judge_fit(fit_);
    }
    fit_.effect = std::sqrt(std::max(0.0, fit_.statistic - fit_.dof) / samples_);
    return fit_;
  }

 private:
  double samples_;
  GoodnessOfFit fit_;
  std::size_t cells_ = 0;
  std::size_t pools_ = 0;
  Pool open_;
  Pool last_;  ///< the last whole pool, which takes what is left over
};

double sum_of(std::span<const std::uint64_t> counts) {
  return static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}));
}

}  // namespace

double power_divergence(double observed, double expected) {
  const double ratio = observed / expected;
  const double divergence =
      1.8 * observed * (std::cbrt(ratio * ratio) - 1.0) + 1.2 * (expected - observed);
  return divergence < 0.0 ? 0.0 : divergence;  // its least value; rounding may leave less
}

void judge_fit(GoodnessOfFit& fit) {
  if (fit.dof <= 0.0) return;
  fit.log10_p = log10_chi_square_tail(fit.statistic, fit.dof);
  if (fit.dof < kLeastDofForLowerTail) return;
  const double lower = log10_chi_square_lower(fit.statistic, fit.dof);
  fit.underdispersed = lower < fit.log10_p;
  const double both = std::min(fit.log10_p, lower) + std::log10(2.0);
  fit.log10_p = both > 0.0 ? 0.0 : both;  // not a number stays so
}

GoodnessOfFit cressie_read(std::span<const std::uint64_t> observed,
                           std::span<const double> probability, std::uint64_t samples) {
  assert(observed.size() == probability.size());
  assert(std::abs(std::accumulate(probability.begin(), probability.end(), 0.0) - 1.0) <= 1e-9);
  assert(std::accumulate(observed.begin(), observed.end(), std::uint64_t{0}) <= samples);
  CressieRead fit(samples);
  for (std::size_t i = 0; i < observed.size(); ++i) fit.add(observed[i], probability[i]);
  return std::move(fit).fit();
}

GoodnessOfFit cressie_read(const Grid<std::uint64_t>& observed, const Grid<double>& probability,
                           std::uint64_t samples) {
  const auto [width, height] = probability.extent();
  assert(observed.extent() == probability.extent());
  CressieRead fit(samples);
  for (int y = 0; y < height; ++y) {
    const bool forwards = y % 2 == 0;
    for (int i = 0; i < width; ++i) {
      const int x = forwards ? i : width - 1 - i;
      fit.add(observed(x, y), probability(x, y));
    }
  }
  return std::move(fit).fit();
}

GoodnessOfFit two_sample_fit(std::span<const std::uint64_t> first,
                             std::span<const std::uint64_t> second) {
  assert(first.size() == second.size());
  const double n1 = sum_of(first);
  const double n2 = sum_of(second);
  if (n1 == 0.0 || n2 == 0.0) {
    GoodnessOfFit nothing;  // no degree of freedom: it can neither accept nor reject
    nothing.possible_cells = first.size();
    return nothing;
  }
  std::vector<double> share;
  for (std::size_t i = 0; i < first.size(); ++i) {
    share.push_back(static_cast<double>(first[i] + second[i]) / (n1 + n2));
  }
  // Pools depend on the shares alone: those of the smaller sample do for both.
  const double fewer = std::min(n1, n2);
  const std::vector<Pool> pools =
      pool_cells<std::uint64_t>(n1 <= n2 ? first : second, share, fewer);
  GoodnessOfFit fit;
  fit.possible_cells = static_cast<std::size_t>(
      std::count_if(share.begin(), share.end(), [](double p) { return p > 0.0; }));
  for (const Pool& pool : pools) {
    const double both = pool.expected / fewer * (n1 + n2);
    const double rest = both - pool.observed;
    fit.statistic += cell_divergence(pool) + cell_divergence({rest, both - pool.expected});
  }
  fit.dof = pools.empty() ? 0.0 : static_cast<double>(pools.size() - 1);
  judge_fit(fit);
  fit.effect = std::sqrt(std::max(0.0, fit.statistic - fit.dof) * (n1 + n2) / (n1 * n2));
  return fit;
}

double minimum_detectable_w(double dof, double level, double power, double samples) {
  const double upper = dof >= kLeastDofForLowerTail ? 0.5 * level : level;
  return std::sqrt(minimum_detectable_noncentrality(dof, upper, power) / samples);
}

double fit_power(std::span<const double> probability, std::span<const double> actual, double level,
                 std::uint64_t samples) {
  const auto n = static_cast<double>(samples);
  std::vector<double> mean;
  for (const double q : actual) mean.push_back(n * q);
  const std::vector<Pool> pools = pool_cells<double>(mean, probability, n);
  if (pools.size() < 2) return 0.0;
  double noncentrality = 0.0;
  for (const Pool& pool : pools) noncentrality += cell_divergence(pool);
  const double dof = static_cast<double>(pools.size() - 1);
  const double upper = dof >= kLeastDofForLowerTail ? 0.5 * level : level;
  return chi_square_power(dof, upper, noncentrality);
}

double critical_count(double mean, double level) {
  namespace policies = boost::math::policies;
  using RoundUp = policies::policy<policies::discrete_quantile<policies::integer_round_up>>;
  const boost::math::poisson_distribution<double, RoundUp> count(mean);
  // The quantile is the least k with P(X > k) <= level.
  return boost::math::quantile(boost::math::complement(count, level)) + 1.0;
}

double minimum_detectable_excess(const WorstCell& worst, double level, double power,
                                 double samples) {
  const double mean = worst.likeliest * samples;
  if (!(mean > 0.0)) return HUGE_VAL;
  // The samplers of a density share it.
  static Memo<3> memo;
  const double excess =
      memo({mean, 0.5 * level / static_cast<double>(worst.cells), power}, [](const auto& argument) {
        const auto& [expected, cell_level, cell_power] = argument;
        return poisson_mean_reaching(critical_count(expected, cell_level), cell_power) / expected -
               1.0;
      });
  return (1.0 + excess) * worst.likeliest <= 1.0 ? excess : HUGE_VAL;
}

WorstCell worst_cell(std::span<const std::uint64_t> observed, std::span<const double> probability,
                     std::uint64_t samples) {
  WorstCell worst;
  double most = -1.0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (probability[i] <= 0.0) continue;
    ++worst.cells;
    worst.likeliest = std::max(worst.likeliest, probability[i]);
    const double o = static_cast<double>(observed[i]);
    const double e = probability[i] * static_cast<double>(samples);
    // Half the deviance: the exponent of Chernoff's bound on the tail.
    const double deviance = (o > 0.0 ? o * std::log(o / e) : 0.0) - (o - e);
    if (deviance <= most) continue;
    most = deviance;
    worst.cell = i;
    worst.observed = o;
    worst.expected = e;
  }
  if (worst.cells == 0) return worst;
  const double tail = worst.observed < worst.expected
                          ? log10_poisson_lower(worst.observed, worst.expected)
                          : log10_poisson_upper(worst.observed, worst.expected);
  worst.log10_p = std::min(0.0, tail + std::log10(2.0 * static_cast<double>(worst.cells)));
  return worst;
}

}  // namespace lightproof
