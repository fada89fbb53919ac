#include "lightproof/stats/level_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lightproof/stats/change_points.h"

namespace lightproof {
namespace {

/// Steps that a fit to so many values has at the most: two, and more in long series.
std::size_t most_steps(std::size_t count) { return std::max<std::size_t>(2, count / 24); }

struct Segment {
  std::size_t first = 0;
  std::size_t end = 0;

  double size() const { return static_cast<double>(end - first); }
};

/// Values less the first one, and their sums.
class Series {
 public:
  explicit Series(std::span<const double> values) : sums_(1, 0.0) {
    for (const double value : values) {
      values_.push_back(value - values.front());
      sums_.push_back(sums_.back() + values_.back());
    }
  }

  double operator[](std::size_t i) const { return values_[i]; }
  std::size_t size() const { return values_.size(); }
  double sum(const Segment& s) const { return sums_[s.end] - sums_[s.first]; }
  double mean(const Segment& s) const { return sum(s) / s.size(); }
  /// What rounding may leave of the squares of residuals.
  double rounding() const {
    double largest = 0.0;
    for (const double value : values_) largest = std::max(largest, std::abs(value));
    const auto count = static_cast<double>(size());
    const double error = count * largest * std::numeric_limits<double>::epsilon();
    return count * error * error;
  }

 private:
  std::vector<double> values_;
  std::vector<double> sums_;
};

/// How much less the squares of a segment's residuals are if it is split.
struct Split {
  std::size_t at = 0;
  double gain = -1.0;
};

Split best_split(const Series& x, const Segment& s) {
  Split best;
  const double mean = x.mean(s);
  for (std::size_t at = s.first + kShortestLevel; at + kShortestLevel <= s.end; ++at) {
    const Segment left = {s.first, at};
    const double excess = x.sum(left) - mean * left.size();
    const double gain = excess * excess * s.size() / (left.size() * (s.size() - left.size()));
    if (gain > best.gain) best = {at, gain};
  }
  return best;
}

std::vector<Segment> fitted_levels(const Series& x) {
  std::vector<Segment> levels = {{0, x.size()}};
  for (std::size_t step = 0; step < most_steps(x.size()); ++step) {
    std::size_t where = 0;
    Split best;
    for (std::size_t k = 0; k < levels.size(); ++k) {
      const Split split = best_split(x, levels[k]);
      if (split.gain <= best.gain) continue;
      best = split;
      where = k;
    }
    if (best.gain < 0.0) break;
    const Segment left = {levels[where].first, best.at};
    levels[where].first = best.at;
    levels.insert(levels.begin() + static_cast<std::ptrdiff_t>(where), left);
  }
  return levels;
}

/// What the levels leave.
struct Scatter {
  double variance = 0.0;     ///< of a value about its level
  double correlation = 0.0;  ///< of neighbours, from 0 to kMostCorrelation
};

Scatter scatter_about(const Series& x, const std::vector<Segment>& levels) {
  double squares = 0.0;
  double products = 0.0;
  for (const Segment& level : levels) {
    const double mean = x.mean(level);
    for (std::size_t i = level.first; i < level.end; ++i) {
      squares += (x[i] - mean) * (x[i] - mean);
      if (i > level.first) products += (x[i] - mean) * (x[i - 1] - mean);
    }
  }
  const auto count = static_cast<double>(x.size());
  const auto means = static_cast<double>(levels.size());
  squares = std::max(squares, x.rounding());
  if (!(squares > 0.0)) return {};
  // About the mean of n values, r is too small by (1 + 4 r) / n; and so for every level.
  const double unbiased = (products / squares * count + means) / std::max(count - 4.0 * means, 4.0);
  return {squares / (count - means), std::clamp(unbiased, 0.0, kMostCorrelation)};
}

}  // namespace

LevelStep clearest_step(std::span<const double> values) {
  const Series x(values);
  const std::vector<Segment> levels = fitted_levels(x);
  const Scatter scatter = scatter_about(x, levels);
  if (!(scatter.variance > 0.0)) return {};  // all values are one
  const double effective = (1.0 - scatter.correlation) / (1.0 + scatter.correlation);
  LevelStep clearest;
  for (std::size_t k = 1; k < levels.size(); ++k) {
    const Segment& before = levels[k - 1];
    const Segment& after = levels[k];
    const double variance =
        scatter.variance * (1.0 / before.size() + 1.0 / after.size()) / effective;
    const double statistic = std::abs(x.mean(after) - x.mean(before)) / std::sqrt(variance);
    if (statistic > clearest.statistic) clearest = {after.first, statistic};
  }
  return clearest;
}

}  // namespace lightproof
