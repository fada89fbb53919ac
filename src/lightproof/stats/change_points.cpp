#include "lightproof/stats/change_points.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lightproof/stats/mann_whitney.h"
#include "lightproof/stats/median.h"

namespace lightproof {
namespace {

struct Segment {
  std::size_t first = 0;
  std::size_t last = 0;  ///< one beyond
};

double median_of(std::span<const double> values) { return median({values.begin(), values.end()}); }

double log10_splits(const Segment& segment) {
  return std::log10(static_cast<double>(segment.last - segment.first - 1));
}

std::optional<std::size_t> split_of(std::span<const double> values, const Segment& segment,
                                    const ChangeRule& rule) {
  std::size_t best = 0;
  double least = 0.0;
  for (std::size_t at = segment.first + 1; at < segment.last; ++at) {
    const double log10_p = log10_mann_whitney_different(
        values.subspan(segment.first, at - segment.first), values.subspan(at, segment.last - at));
    if (log10_p >= least) continue;
    least = log10_p;
    best = at;
  }
  if (best == 0 || least + log10_splits(segment) > std::log10(rule.alpha)) return std::nullopt;
  const double ratio = median_of(values.subspan(best, segment.last - best)) /
                       median_of(values.subspan(segment.first, best - segment.first));
  if (std::max(ratio, 1.0 / ratio) <= rule.least_ratio) return std::nullopt;
  return best;
}

/// Ascending, as the left side is searched before the right one.
void search(std::span<const double> values, const Segment& segment, const ChangeRule& rule,
            std::vector<std::size_t>& splits) {
  if (segment.last - segment.first < 2) return;
  const std::optional<std::size_t> split = split_of(values, segment, rule);
  if (!split) return;
  search(values, {segment.first, *split}, rule, splits);
  splits.push_back(*split);
  search(values, {*split, segment.last}, rule, splits);
}

}  // namespace

std::vector<ChangePoint> change_points(std::span<const double> values, const ChangeRule& rule) {
  std::vector<std::size_t> splits;
  search(values, {0, values.size()}, rule, splits);
  std::vector<ChangePoint> changes;
  for (std::size_t i = 0; i < splits.size(); ++i) {
    const std::size_t from = i == 0 ? 0 : splits[i - 1];
    const std::size_t to = i + 1 == splits.size() ? values.size() : splits[i + 1];
    const auto before = values.subspan(from, splits[i] - from);
    const auto after = values.subspan(splits[i], to - splits[i]);
    const double log10_p = log10_mann_whitney_different(before, after) + log10_splits({from, to});
    changes.push_back({splits[i], median_of(after) / median_of(before), std::min(0.0, log10_p)});
  }
  return changes;
}

}  // namespace lightproof
