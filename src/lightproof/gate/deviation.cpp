#include "lightproof/gate/deviation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "lightproof/stats/goodness_of_fit.h"

namespace lightproof {
namespace {

/// Standard deviations beyond which the farthest stretch of a few thousand is no chance: 1e-6 by
/// Bonferroni over 10^4 of them.
constexpr double kBeyondChance = 6.4;

struct Stretch {
  std::size_t first = 0;
  std::size_t last = 0;
  double ratio = 1.0;      ///< drawn over expected
  double deviation = 0.0;  ///< in standard deviations, without its sign
};

/// The farthest of all stretches whose lengths are powers of two, at multiples of half of these.
Stretch farthest_stretch(std::span<const std::uint64_t> counts, std::span<const double> masses,
                         double samples) {
  Stretch farthest;
  for (std::size_t length = 1; length <= counts.size(); length *= 2) {
    const std::size_t step = std::max<std::size_t>(1, length / 2);
    for (std::size_t first = 0; first + length <= counts.size(); first += step) {
      double observed = 0.0;
      double mass = 0.0;
      for (std::size_t i = first; i < first + length; ++i) {
        observed += static_cast<double>(counts[i]);
        mass += masses[i];
      }
      const double expected = samples * mass;
      const double variance = expected * std::max(1.0 - mass, 0.0);
      if (!(variance >= kPooledExpectation)) continue;
      const double deviation = std::abs(observed - expected) / std::sqrt(variance);
      if (deviation > farthest.deviation) {
        farthest = {first, first + length - 1, observed / expected, deviation};
      }
    }
  }
  return farthest;
}

std::string sentence(std::string_view what, const Stretch& stretch) {
  const std::string where =
      stretch.first == stretch.last
          ? fmt::format("{} {} is", what, stretch.first)
          : fmt::format("{}s {} to {} are", what, stretch.first, stretch.last);
  const double percent = 100.0 * (stretch.ratio - 1.0);
  return fmt::format("{} drawn {:.3g} % too {} ({:.3g} standard deviations)", where,
                     std::abs(percent), percent > 0.0 ? "often" : "rarely", stretch.deviation);
}

const TestRecord* farthest_rejection(std::span<const TestRecord> records) {
  const TestRecord* farthest = nullptr;
  const auto p = [](const TestRecord& record) { return record.log10_p.value_or(-1e308); };
  for (const TestRecord& record : records) {
    if (record.outcome != Outcome::reject) continue;
    if (farthest == nullptr || p(record) < p(*farthest)) farthest = &record;
  }
  return farthest;
}

}  // namespace

std::string describe_deviation(const Expectation& expectation, const Evidence& evidence) {
  const Draws& draws = *evidence.draws;
  const auto samples = static_cast<double>(draws.samples);
  const Stretch rows = farthest_stretch(row_counts(draws.texels), expectation.rows, samples);
  const Stretch columns =
      farthest_stretch(column_counts(draws.texels), expectation.columns, samples);
  const WorstCell texel =
      worst_cell(draws.texels.values(), expectation.masses.values(), draws.samples);
  std::vector<std::string> parts;
  if (rows.deviation > kBeyondChance) parts.push_back(sentence("row", rows));
  if (columns.deviation > kBeyondChance) parts.push_back(sentence("column", columns));
  if (parts.empty() && texel.log10_p < -6.0) {
    const auto width = static_cast<std::size_t>(expectation.masses.extent().width);
    parts.push_back(fmt::format("texel ({}, {}) is drawn {} times where {:.4g} are expected",
                                texel.cell % width, texel.cell / width, texel.observed,
                                texel.expected));
  }
  if (parts.empty()) {
    const TestRecord* test = farthest_rejection(evidence.records);
    if (test == nullptr) return "";
    return fmt::format("{} is off by {:.3g}{}{}", full_name(test->test), test->effect,
                       test->detail.empty() ? "" : ": ", test->detail);
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace lightproof
