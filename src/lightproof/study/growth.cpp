#include "lightproof/study/growth.h"

#include <algorithm>
#include <cmath>

#include "lightproof/samplers/registry.h"
#include "lightproof/stats/power_law.h"
#include "lightproof/stats/segmented_regression.h"

namespace lightproof {
namespace {

/// Probability that any of the samplers bends if all are straight.
constexpr double kFamilyAlpha = 0.01;
/// Points that leave something to tell a line's scatter by.
constexpr std::size_t kLeastPoints = 3;

double sides(Extent extent) { return extent.width + extent.height; }
double texels(Extent extent) { return static_cast<double>(extent.count()); }

/// The sampler's records, ascending by size.
std::vector<ThroughputRecord> records_of(std::string_view sampler,
                                         std::span<const ThroughputRecord> records) {
  std::vector<ThroughputRecord> own;
  for (const ThroughputRecord& record : records) {
    if (record.sampler == sampler) own.push_back(record);
  }
  std::stable_sort(own.begin(), own.end(), [](const auto& a, const auto& b) {
    return a.extent.count() < b.extent.count();
  });
  return own;
}

/// The scatter about the power law, not the repetitions, is what the exponent is uncertain by.
std::optional<FittedExponent> exponent_of(const std::vector<PowerLawPoint>& points) {
  if (points.size() < kLeastPoints) return std::nullopt;
  const PowerLaw fit = fit_power_law(points);
  double variance = 0.0;
  for (const PowerLawPoint& point : points) {
    const double residual = std::log(point.y / (fit.constant * std::pow(point.x, fit.exponent)));
    variance += residual * residual / static_cast<double>(points.size() - 2);
  }
  return FittedExponent{fit.exponent, fit.exponent_error * std::sqrt(variance)};
}

/// The exponent of what a record holds against what its size is; values that are not positive are
/// left out.
std::optional<FittedExponent> exponent_of(const std::vector<ThroughputRecord>& records,
                                          double ThroughputRecord::*cost, double (*size)(Extent)) {
  std::vector<PowerLawPoint> points;
  for (const ThroughputRecord& record : records) {
    if (record.*cost > 0.0) points.push_back({size(record.extent), record.*cost, 1.0});
  }
  return exponent_of(points);
}

std::optional<Extent> first_beyond(const std::vector<ThroughputRecord>& records,
                                   const std::optional<double>& cache) {
  if (!cache) return std::nullopt;
  const auto found = std::find_if(records.begin(), records.end(),
                                  [&](const auto& record) { return record.table_bytes > *cache; });
  if (found == records.end()) return std::nullopt;
  return found->extent;
}

std::vector<DataPoint> logarithms_of(const std::vector<StepTime>& steps) {
  std::vector<DataPoint> points;
  for (const StepTime& step : steps) {
    points.push_back({std::log(sides(step.extent)), std::log(step.ns)});
  }
  return points;
}

/// The breakpoints of all samplers, judged together.
void add_breakpoints(std::vector<GrowthFit>& fits) {
  std::vector<std::vector<DataPoint>> lines;
  for (const GrowthFit& fit : fits) lines.push_back(logarithms_of(fit.steps));
  const std::vector<std::optional<SegmentedLine>> segmented = segmented_lines(lines, kFamilyAlpha);
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (!segmented[i]) continue;
    fits[i].segmented = SegmentedGrowth{segmented[i]->slope, {}, segmented[i]->p_value};
    for (const Breakpoint& breakpoint : segmented[i]->breakpoints) {
      fits[i].segmented->breakpoints.push_back(
          {fits[i].steps[breakpoint.point].extent, breakpoint.slope_after});
    }
  }
}

}  // namespace

std::vector<GrowthFit> growth_of(std::span<const ThroughputRecord> records,
                                 const CacheSizes& caches) {
  std::vector<GrowthFit> fits;
  for (const SamplerInfo& sampler : samplers()) {
    const std::vector<ThroughputRecord> own = records_of(sampler.name, records);
    const auto exponent = exponent_of(own, &ThroughputRecord::ns_per_sample, sides);
    if (!exponent) continue;
    GrowthFit fit = {std::string(sampler.name),
                     std::string(sampler.growth),
                     exponent->value,
                     exponent->error,
                     {}};
    for (const ThroughputRecord& record : own) {
      if (!(record.ns_per_sample > 0.0)) continue;
      fit.steps.push_back({record.extent, record.ns_per_sample / sampler.steps(record.extent)});
    }
    fit.leaves_l2 = first_beyond(own, caches.l2);
    fit.leaves_l3 = first_beyond(own, caches.l3);
    fit.build_exponent = exponent_of(own, &ThroughputRecord::build_ms, texels);
    fits.push_back(std::move(fit));
  }
  add_breakpoints(fits);
  return fits;
}

}  // namespace lightproof
