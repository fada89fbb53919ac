#include "lightproof/check/weight_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "lightproof/check/compared_samples.h"
#include "lightproof/check/estimate_sums.h"

namespace lightproof {
namespace {

/// Names of the channels of a coloured weight in messages.
constexpr std::array kNames = {"red of the weight", "green of the weight", "blue of the weight"};

class WeightCheck {
 public:
  WeightCheck(const SampleDump& dump, const EnvironmentMap& map, const EnvironmentMap& colours,
              double tolerance)
      : dump_(&dump),
        mapping_(map.mapping),
        luminance_(luminance_of(map)),
        colours_(&colours),
        tolerance_(tolerance + 2.0 * dump.rounding()) {}

  void set(TestRecord& record) const {
    std::vector<SampleWeight> weights(kSampleBlock);
    std::uint64_t off = 0;
    record.samples = 0;
    visit_spread(*dump_, [&](std::uint64_t first, std::span<const DumpedSample> samples) {
      dump_->read_weights(first, std::span(weights).first(samples.size()));
      record.samples += samples.size();
      for (std::size_t i = 0; i < samples.size(); ++i) {
        if (!is_usable(samples[i], true)) continue;
        const Misfit found = misfit_of(samples[i], weights[i]);
        if (found.error <= tolerance_) continue;  // false for NaN
        ++off;
        if (off > 1 && !(found.error > record.effect)) continue;
        record.effect = found.error;
        record.detail = fmt::format(
            "the worst: sample {}, counted from 0: {} {:.6g} where "
            "L/pdf is {:.6g}",
            first + i, dump_->has_coloured_weights() ? kNames[found.channel] : "weight",
            weights[i][found.channel], found.expected);
      }
    });
    record.statistic = static_cast<double>(off);
    if (off == 0) return;
    record.outcome = Outcome::reject;
    record.detail = fmt::format("{} weights are off, {}", off, record.detail);
  }

 private:
  SampleWeight light_at(Direction d) const {
    const SquarePoint at = square_point_of(mapping_, d);
    const int x = cell_of(at.s, luminance_.extent().width);
    const int y = cell_of(at.t, luminance_.extent().height);
    if (!dump_->has_coloured_weights()) {
      return {luminance_(x, y), luminance_(x, y), luminance_(x, y)};
    }
    const Rgb rgb = colours_->radiance(x, y);
    return {rgb.r, rgb.g, rgb.b};
  }

  /// What is wrong with a weight, in the channel that is off the most.
  struct Misfit {
    double error = 0.0;  ///< relative to the largest channel of what is expected
    std::size_t channel = 0;
    double expected = 0.0;  ///< of the channel
  };

  static Misfit misfit(const SampleWeight& weight, const SampleWeight& light, double pdf) {
    Misfit found;
    double most = 0.0;
    double largest = 0.0;
    for (std::size_t c = 0; c < weight.size(); ++c) {
      const double expected = light[c] / pdf;
      if (std::isnan(weight[c])) return {std::numeric_limits<double>::infinity(), c, expected};
      const double distance = std::abs(weight[c] - expected);
      if (distance > most) found = {0.0, c, expected};
      most = std::max(most, distance);
      largest = std::max(largest, expected);
    }
    if (most > 0.0) found.error = most / largest;
    return found;
  }

  /// By the texel, or one within the rounding of the direction, that fits best.
  Misfit misfit_of(const DumpedSample& sample, const SampleWeight& weight) const {
    Misfit least = misfit(weight, light_at(sample.direction), sample.pdf.value);
    if (least.error <= tolerance_) return least;
    visit_around(sample.direction, dump_->rounding(), [&](Direction turned) {
      const Misfit other = misfit(weight, light_at(turned), sample.pdf.value);
      if (other.error < least.error) least = other;
    });
    return least;
  }

  const SampleDump* dump_;
  Mapping mapping_;
  Grid<double> luminance_;
  const EnvironmentMap* colours_;
  double tolerance_;
};

}  // namespace

void check_weights(const SampleDump& dump, const EnvironmentMap& map, const EnvironmentMap& colours,
                   double tolerance, TestRecord& record) {
  WeightCheck(dump, map, colours, tolerance).set(record);
}

}  // namespace lightproof
