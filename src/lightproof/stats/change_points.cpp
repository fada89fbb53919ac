#include "lightproof/stats/change_points.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"
#include "lightproof/stats/family.h"
#include "lightproof/stats/level_steps.h"
#include "lightproof/stats/median.h"

namespace lightproof {
namespace {

/// Simulated series that a series is ranked among, at the least.
constexpr std::size_t kLeastSimulated = 9999;
/// The number of lines that may step as clearly as one that is told from them at Holm's strictest
/// level.
constexpr double kRanksAtLevel = 4.0;

double median_of(std::span<const double> values) { return median({values.begin(), values.end()}); }

/// Standard normal errors with kMostCorrelation between neighbours.
std::vector<double> correlated_errors(std::size_t count, const RandomStream& stream) {
  static const double fresh = std::sqrt(1.0 - kMostCorrelation * kMostCorrelation);
  std::vector<double> errors;
  errors.reserve(count + 1);
  const auto add = [&](double normal) {
    errors.push_back(errors.empty() ? normal : kMostCorrelation * errors.back() + fresh * normal);
  };
  for (std::size_t i = 0; errors.size() < count; ++i) {
    const SquarePoint u = stream.point(i);
    const double radius = std::sqrt(-2.0 * std::log(1.0 - u.s));  // Box and Muller
    add(radius * std::cos(2.0 * std::numbers::pi * u.t));
    add(radius * std::sin(2.0 * std::numbers::pi * u.t));
  }
  errors.resize(count);
  return errors;
}

/// Statistics of simulated series of one level, in ascending order, for each number of values.
class OneLevel {
 public:
  explicit OneLevel(std::size_t simulated) : simulated_(simulated) {}

  /// log10 of the p-value of a statistic of so many values.
  double log10_p(std::size_t count, double statistic) {
    const std::vector<double>& all = of(count);
    const auto as_clear = all.end() - std::ranges::lower_bound(all, statistic);
    return std::log10(static_cast<double>(as_clear + 1) / static_cast<double>(all.size() + 1));
  }

 private:
  const std::vector<double>& of(std::size_t count) {
    std::vector<double>& all = by_count_[count];
    if (!all.empty()) return all;
    all.resize(simulated_);
    const RandomStream stream("one level", count);
    constexpr std::size_t kChunk = 256;
    parallel_chunks(all.size(), kChunk, [&](std::size_t, std::size_t i, std::size_t end) {
      for (; i < end; ++i) {
        all[i] = clearest_step(correlated_errors(count, stream.substream(i))).statistic;
      }
    });
    std::ranges::sort(all);
    return all;
  }

  std::size_t simulated_;
  std::map<std::size_t, std::vector<double>> by_count_;
};

/// A step, with its p-value.
struct Step {
  std::size_t first = 0;
  double log10_p = 0.0;
};

bool is_tested(std::size_t count) { return count >= 2 * kShortestLevel; }

Step step_of(std::span<const double> logarithms, OneLevel& one_level) {
  const LevelStep step = clearest_step(logarithms);
  return {step.first, one_level.log10_p(logarithms.size(), step.statistic)};
}

std::vector<double> logarithms_of(const std::vector<double>& values) {
  std::vector<double> logarithms;
  for (const double value : values) logarithms.push_back(std::log(value));
  return logarithms;
}

/// The search of one series, at the level at which it was found to have changed.
class Search {
 public:
  Search(std::span<const double> values, double log10_level, double least_ratio,
         OneLevel& one_level)
      : values_(values),
        log10_level_(log10_level),
        least_ratio_(least_ratio),
        one_level_(one_level) {}

  std::vector<ChangePoint> operator()(std::span<const double> logarithms) {
    search(logarithms, 0);
    // The smallest step goes first: its levels become one, which may make those beside it larger.
    for (;;) {
      set_ratios();
      const auto smallest = std::ranges::min_element(changes_, {}, size_of);
      if (smallest == changes_.end() || size_of(*smallest) > std::log(least_ratio_)) break;
      changes_.erase(smallest);
    }
    return std::move(changes_);
  }

 private:
  static double size_of(const ChangePoint& change) { return std::abs(std::log(change.ratio)); }

  /// Sets the ratio of each change: the median of the level after it over that of the one before.
  void set_ratios() {
    for (std::size_t i = 0; i < changes_.size(); ++i) {
      const std::size_t from = i == 0 ? 0 : changes_[i - 1].first;
      const std::size_t to = i + 1 == changes_.size() ? values_.size() : changes_[i + 1].first;
      changes_[i].ratio = ratio_at(changes_[i].first, from, to);
    }
  }

  double ratio_at(std::size_t at, std::size_t from, std::size_t to) const {
    return median_of(values_.subspan(at, to - at)) / median_of(values_.subspan(from, at - from));
  }

  /// Ascending, as the left side is searched before the right one.
  void search(std::span<const double> part, std::size_t from) {
    if (!is_tested(part.size())) return;
    const Step step = step_of(part, one_level_);
    if (step.log10_p > log10_level_) return;
    const std::size_t at = from + step.first;
    search(part.first(step.first), from);
    changes_.push_back({at, 1.0, step.log10_p});
    search(part.subspan(step.first), at);
  }

  std::span<const double> values_;
  double log10_level_;
  double least_ratio_;
  OneLevel& one_level_;
  std::vector<ChangePoint> changes_;
};

}  // namespace

std::vector<std::vector<ChangePoint>> change_points(std::span<const std::vector<double>> series,
                                                    const ChangeRule& rule) {
  std::vector<std::size_t> tested;
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (is_tested(series[i].size())) tested.push_back(i);
  }
  const double strictest = strictest_level(rule.alpha, tested.size());
  OneLevel one_level(
      std::max(kLeastSimulated, static_cast<std::size_t>(kRanksAtLevel / strictest)));
  std::vector<double> log10_p;
  for (const std::size_t i : tested) {
    log10_p.push_back(step_of(logarithms_of(series[i]), one_level).log10_p);
  }
  const std::vector<bool> changed = holm_rejections(log10_p, rule.alpha);
  std::vector<std::vector<ChangePoint>> changes(series.size());
  for (std::size_t k = 0; k < tested.size(); ++k) {
    if (!changed[k]) continue;
    const std::vector<double>& values = series[tested[k]];
    // Holm's level for this series is no lower than either.
    const double log10_level = std::max(log10_p[k], std::log10(strictest));
    changes[tested[k]] =
        Search(values, log10_level, rule.least_ratio, one_level)(logarithms_of(values));
  }
  return changes;
}

}  // namespace lightproof
