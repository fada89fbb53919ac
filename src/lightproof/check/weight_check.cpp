#include "lightproof/check/weight_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "lightproof/check/compared_samples.h"
#include "lightproof/check/estimate_sums.h"

namespace lightproof {
namespace {

constexpr std::size_t kBatch = 4096;
constexpr std::uint64_t kMostCompared = std::uint64_t{1} << 22U;

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
    std::vector<DumpedSample> samples(kBatch);
    std::vector<SampleWeight> weights(kBatch);
    const std::uint64_t blocks = (dump_->count() + kBatch - 1) / kBatch;
    const std::uint64_t step = std::max<std::uint64_t>(1, blocks * kBatch / kMostCompared);
    std::uint64_t off = 0;
    record.samples = 0;
    for (std::uint64_t number = 0; number < blocks; number += step) {
      const std::uint64_t first = number * kBatch;
      const auto size =
          static_cast<std::size_t>(std::min<std::uint64_t>(kBatch, dump_->count() - first));
      dump_->read(first, std::span(samples).first(size));
      dump_->read_weights(first, std::span(weights).first(size));
      record.samples += size;
      for (std::size_t i = 0; i < size; ++i) {
        if (!is_usable(samples[i], true)) continue;
        const double error = error_of(samples[i], weights[i]);
        if (error <= tolerance_) continue;  // false for NaN
        ++off;
        if (off > 1 && !(error > record.effect)) continue;
        record.effect = error;
        record.detail = fmt::format(
            "the worst: sample {}, counted from 0: weight {:.6g} where "
            "L/pdf is {:.6g}",
            first + i, weights[i][0], expected(samples[i])[0]);
      }
    }
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

  SampleWeight expected(const DumpedSample& sample) const {
    SampleWeight light = light_at(sample.direction);
    for (double& channel : light) channel /= sample.pdf.value;
    return light;
  }

  static double distance(const SampleWeight& weight, const SampleWeight& light, double pdf) {
    double most = 0.0;
    double largest = 0.0;
    for (std::size_t c = 0; c < weight.size(); ++c) {
      most = std::max(most, std::abs(weight[c] - light[c] / pdf));
      largest = std::max(largest, light[c] / pdf);
      if (std::isnan(weight[c])) return std::numeric_limits<double>::infinity();
    }
    return most == 0.0 ? 0.0 : most / largest;
  }

  /// By the texel, or one within the rounding of the direction, that fits best.
  double error_of(const DumpedSample& sample, const SampleWeight& weight) const {
    double least = distance(weight, light_at(sample.direction), sample.pdf.value);
    if (least <= tolerance_) return least;
    visit_around(sample.direction, dump_->rounding(), [&](Direction turned) {
      least = std::min(least, distance(weight, light_at(turned), sample.pdf.value));
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
