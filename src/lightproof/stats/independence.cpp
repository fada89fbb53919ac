#include "lightproof/stats/independence.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace lightproof {
namespace {

/// Two by two cells in one.
Grid<std::uint64_t> merged(const Grid<std::uint64_t>& counts) {
  Grid<std::uint64_t> half({counts.extent().width / 2, counts.extent().height / 2});
  for (int y = 0; y < counts.extent().height; ++y) {
    for (int x = 0; x < counts.extent().width; ++x) half(x / 2, y / 2) += counts(x, y);
  }
  return half;
}

struct Margins {
  std::vector<double> rows;
  std::vector<double> columns;
  double total = 0.0;
};

Margins margins_of(const Grid<std::uint64_t>& counts) {
  const Extent extent = counts.extent();
  Margins margins{std::vector<double>(static_cast<std::size_t>(extent.height)),
                  std::vector<double>(static_cast<std::size_t>(extent.width))};
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const auto count = static_cast<double>(counts(x, y));
      margins.rows[static_cast<std::size_t>(y)] += count;
      margins.columns[static_cast<std::size_t>(x)] += count;
      margins.total += count;
    }
  }
  return margins;
}

double positive_less_one(const std::vector<double>& sums) {
  const auto positive = std::count_if(sums.begin(), sums.end(), [](double s) { return s > 0.0; });
  return static_cast<double>(std::max<std::ptrdiff_t>(positive - 1, 0));
}

std::uint64_t total_of(const Grid<std::uint64_t>& counts) {
  const auto values = counts.values();
  return std::accumulate(values.begin(), values.end(), std::uint64_t{0});
}

/// Cells a side over which so many counts are 25 each on average.
int cells_for(std::uint64_t counts, int cells) {
  while (cells > 1 && static_cast<double>(counts) < kPooledExpectation * cells * cells) cells /= 2;
  return cells;
}

}  // namespace

double independence_dof(std::uint64_t counts, int cells) {
  const double side = cells_for(counts, cells) - 1;
  return side * side;
}

GoodnessOfFit independence_fit(const Grid<std::uint64_t>& counts) {
  const std::uint64_t samples = total_of(counts);
  Grid<std::uint64_t> cells = counts;
  const int side = cells_for(samples, counts.extent().width);
  while (cells.extent().width > side) cells = merged(cells);
  const Margins margins = margins_of(cells);
  GoodnessOfFit fit;
  fit.possible_cells = cells.extent().count();
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double expected = margins.rows[static_cast<std::size_t>(y)] *
                              margins.columns[static_cast<std::size_t>(x)] / margins.total;
      if (!(expected > 0.0)) continue;  // a row or column without counts
      fit.statistic += power_divergence(static_cast<double>(cells(x, y)), expected);
    }
  }
  fit.dof = positive_less_one(margins.rows) * positive_less_one(margins.columns);
  judge_fit(fit);
  fit.effect =
      samples > 0 ? std::sqrt(std::max(0.0, fit.statistic - fit.dof) / margins.total) : 0.0;
  return fit;
}

GoodnessOfFit sum_of_fits(std::span<const GoodnessOfFit> fits, std::uint64_t samples) {
  GoodnessOfFit sum;
  for (const GoodnessOfFit& fit : fits) {
    sum.statistic += fit.statistic;
    sum.dof += fit.dof;
    sum.possible_cells += fit.possible_cells;
  }
  judge_fit(sum);
  if (samples > 0) {
    sum.effect = std::sqrt(std::max(0.0, sum.statistic - sum.dof) / static_cast<double>(samples));
  }
  return sum;
}

double irwin_hall_cdf(int terms, double x) {
  if (x <= 0.0) return 0.0;
  if (x > 0.5 * terms) return 1.0 - irwin_hall_cdf(terms, terms - x);  // where signs cancel less
  // 1/n! sum_k (-1)^k (n over k) (x - k)^n over k <= x.
  double sum = 0.0;
  double binomial = 1.0;
  for (int k = 0; k <= x; ++k) {
    sum += binomial * std::pow(x - k, terms);
    binomial *= -static_cast<double>(terms - k) / (k + 1);
  }
  return sum / std::tgamma(terms + 1.0);
}

std::vector<double> irwin_hall_quantiles(int terms, int cells) {
  const boost::math::tools::eps_tolerance<double> close(50);
  std::vector<double> quantiles;
  for (int i = 1; i < cells; ++i) {
    const auto excess = [&](double x) {
      return irwin_hall_cdf(terms, x) - static_cast<double>(i) / cells;
    };
    std::uintmax_t most_steps = 1000;
    quantiles.push_back(boost::math::tools::toms748_solve(excess, 0.0, static_cast<double>(terms),
                                                          close, most_steps)
                            .second);
  }
  return quantiles;
}

}  // namespace lightproof
