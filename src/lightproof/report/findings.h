// What the numbers say, in sentences. Every claim is computed from the data it stands above, and
// the worst case is named wherever not everything agrees. Plain text (UTF-8), not escaped.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/image/target_density.h"
#include "lightproof/report/pareto.h"
#include "lightproof/results/study_result.h"

namespace lightproof {

/// The headline: the verdict on all samplers but those that are kept with known defects.
std::string headline(const StudyResult& study);

/// What was found of one sampler.
struct SamplerFinding {
  Outcome outcome = Outcome::inconclusive;
  std::string sentence;
  bool is_demonstration = false;  ///< whether it is kept as published and decides nothing
};

/// What was found of each sampler in one sentence, with the worst test of those that are not
/// accepted.
std::vector<SamplerFinding> sampler_findings(const GateResult& gate);

/// Do the errors fall as N^(-1/2)? Judged at 3 standard errors of each fitted slope.
std::string convergence_finding(const std::vector<ConvergenceRecord>& records);

/// How many points lie within 3 standard errors of the predicted error. Points whose standard
/// error exceeds a third of the prediction hardly test it: they are counted apart.
std::string prediction_finding(const std::vector<ConvergenceRecord>& records);

/// Is the measured variance the predicted one? Judged at 3 standard errors of each ratio.
std::string variance_finding(const std::vector<ConvergenceRecord>& records);

/// How much faster the fastest correct sampler on the largest map is than the baseline (the
/// published linear scan where there is one, else the slowest sampler), and whether that grows with
/// the map.
std::string throughput_finding(const StudyResult& study);

/// The sizes at which a sampler's steps are fastest and slowest. The fit has at least one size.
struct StepRange {
  StepTime fastest;
  StepTime slowest;
};
/// The fastest and the slowest step of a sampler over all sizes.
StepRange step_range(const GrowthFit& fit);

/// How many steps each sampler takes, and whether they stay as fast as the map grows.
std::string growth_finding(const std::vector<GrowthFit>& growth);

/// From where to where tables outgrow L2 and L3, with the first sampler and the last.
std::string caches_finding(const std::vector<GrowthFit>& growth, const CacheSizes& caches);

/// The samplers whose time of a step has a breakpoint, and where.
std::string breakpoints_finding(const std::vector<GrowthFit>& growth);

/// How the time to build grows, and who takes longest on the largest map; empty if nothing was
/// measured.
std::string build_finding(const StudyResult& study);

/// Which tables are beaten by none in speed, memory and accuracy at once, on the largest map.
/// `records` is not empty.
std::string tables_finding(const std::vector<TableRecord>& records);

/// The exact variances of the estimators that draw from the map by one of kDensities each, in one
/// place: on one map, receiver and material.
struct DensityVariances {
  const ConvergenceRecord* scene;  ///< one of the records, which names the scene
  /// Per sample, relative to mean^2, in the order of kDensities; not a number where unknown.
  std::array<double, kDensities.size()> variances;
  std::size_t least;  ///< index of the least one
};

/// The places where the variances of at least two densities are predicted, in the records' order.
std::vector<DensityVariances> density_variances(const std::vector<ConvergenceRecord>& records);

/// Which density has the least variance in how many places. Empty if there are no places.
std::string density_finding(const std::vector<DensityVariances>& scenes);

/// How many times fewer samples the best estimator needs than the worst for the same error, by the
/// predicted variances. `records` is not empty.
std::string saving_finding(const std::vector<const ConvergenceRecord*>& records);

/// Which estimator has the smallest error in one scene. `scene` is not empty.
std::string render_finding(const std::vector<const RenderRecord*>& scene);

/// Which estimator wins how often over all scenes. `renders` is not empty.
std::string renders_finding(const std::vector<RenderRecord>& renders);

/// How far the split sum is off at most, and how often it is visibly so. `records` is not empty.
std::string split_sum_finding(const std::vector<SplitSumRecord>& records);

/// A record's angle between view and normal in degrees.
double view_degrees(const SplitSumRecord& record);

/// An error in percent, "12.3 %"; below 0.01 % only that.
std::string percent_text(double fraction);

/// The error of a record in percent, with a "at least" sign where detail that is left out may add
/// to it.
std::string split_sum_text(const SplitSumRecord& record);

/// A number without zeros at its end: "0.04".
std::string plain_number(double value);

/// What the effective fraction means for this map, with the variance of uniform sampling.
std::string map_finding(const MapRecord& map);

/// Whether the variance is so small, measured and predicted (below 1e-8 of mean^2), that rounding
/// and quadrature decide it: nothing to compare or to draw.
bool is_all_but_exact(const ConvergenceRecord& record);

/// Whether measured / predicted variance has a standard error, and the estimator is not all but
/// exact.
bool has_ratio(const ConvergenceRecord& record);

/// Whether the standard error of the ratio is at most a third: the ratio says something.
bool has_telling_ratio(const ConvergenceRecord& record);

/// Whether a slope could be fitted, with a standard error.
bool has_slope(const ConvergenceRecord& record);

}  // namespace lightproof
