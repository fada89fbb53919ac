#include "lightproof/gate/sequential_gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "lightproof/core/out_of_memory.h"
#include "lightproof/core/parallel.h"
#include "lightproof/gate/diagnosis.h"
#include "lightproof/gate/records.h"
#include "lightproof/gate/test_run.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/sequential.h"

namespace lightproof {
namespace {

constexpr std::uint64_t kFirstLook = 1024;
/// A look at more cells than this takes longer than drawing.
constexpr std::size_t kMostCells = std::size_t{1} << 15U;

/// log10 of the average of 10^x.
double log10_average(std::span<const double> values) {
  const double most = *std::max_element(values.begin(), values.end());
  if (std::isinf(most)) return most;
  double sum = 0.0;
  for (const double value : values) sum += std::pow(10.0, value - most);
  return most + std::log10(sum / static_cast<double>(values.size()));
}

/// The e-processes of one distribution.
class EProcesses {
 public:
  explicit EProcesses(const Expectation& expectation)
      : bins_(expectation.bins.values()), rows_(expectation.rows), columns_(expectation.columns) {
    const auto texels = expectation.masses.values();
    if (texels.size() <= kMostCells) texels_.emplace(texels);
  }

  /// Of all samples so far; infinite once one lies where none can.
  double log10_e(const Draws& draws) const {
    if (draws.out_of_domain.count > 0 || draws.zero_density.count > 0) return INFINITY;
    std::vector<double> all = {bins_.log10_e(draws.bins.values()),
                               rows_.log10_e(row_counts(draws.texels)),
                               columns_.log10_e(column_counts(draws.texels))};
    if (texels_) all.push_back(texels_->log10_e(draws.texels.values()));
    return log10_average(all);
  }

  /// The effect on the bins that would be known for wrong after so many samples.
  double minimum_detectable_effect(double log10_enough, std::uint64_t samples) const {
    const double processes = texels_ ? 4.0 : 3.0;
    return bins_.minimum_detectable_effect(std::pow(10.0, -log10_enough) / processes,
                                           kDetectionPower, static_cast<double>(samples));
  }

 private:
  SequentialTest bins_;
  SequentialTest rows_;
  SequentialTest columns_;
  std::optional<SequentialTest> texels_;
};

/// The records of one instance, and what a diagnosis needs of it.
struct Finding {
  std::vector<TestRecord> records;
  Inspection inspection;
  std::optional<Draws> draws;  ///< there if a record is rejected
};

/// Draws until the evidence reaches `enough` (log10), or to the end.
Finding watch(const TestRun& run, const Expectation& expectation, const GateOptions& options,
              double enough) {
  const BoundSampler sampler = run.instance->bind();
  const EProcesses evidence(expectation);
  const RandomStream stream = run.stream("sequential");
  Draws draws(expectation.masses.extent(), expectation.bands.size());
  const std::uint64_t most = std::min(options.samples, sampler.count.value_or(options.samples));
  double log10_e = 0.0;
  for (std::uint64_t next = kFirstLook; log10_e < enough && draws.samples < most;
       next += next / 2) {
    const std::uint64_t target = std::min(next, most);
    const Draws more =
        draw_samples(sampler, expectation, stream, {draws.samples, target - draws.samples});
    draws.merge(more);
    log10_e = evidence.log10_e(draws);
  }
  TestRecord record = record_of(run, TestId::sequential, draws.samples);
  record.statistic = log10_e;
  record.log10_p = std::min(0.0, -log10_e);
  record.outcome = log10_e >= enough ? Outcome::reject : Outcome::accept;
  const auto failure = failure_of([&] {
    const double minimum_detectable = evidence.minimum_detectable_effect(enough, most);
    if (std::isfinite(minimum_detectable)) record.minimum_detectable_effect = minimum_detectable;
    record.effect =
        cressie_read(serpentine(draws.bins), serpentine(expectation.bins), draws.samples).effect;
  });
  require_power(record, options.must_detect);
  if (failure && record.outcome == Outcome::accept) {
    record.outcome = Outcome::inconclusive;
    record.detail = "its power could not be computed: " + *failure;
  }
  if (std::isinf(log10_e)) {
    record.detail = fmt::format("one of {} samples lies where none can", draws.samples);
  } else if (record.outcome == Outcome::reject) {
    record.detail = fmt::format("known after {} samples: evidence 10^{:.3g}, 10^{:.3g} is enough",
                                draws.samples, log10_e, enough);
  }
  const Inspection inspection = run.instance->inspect(sampler, expectation, run.instance->rounding);
  const std::optional<BoundSampler> reference_implementation =
      run.instance->claims_reference_texels
          ? std::optional(run.test_case->reference_implementation())
          : std::nullopt;
  Finding finding{{record}, inspection, {}};
  for (const auto& tests :
       {test_validity(run, draws),
        test_exactly(run, expectation, sampler, inspection, draws,
                     reference_implementation ? &*reference_implementation : nullptr)}) {
    for (const Measured& test : tests) finding.records.push_back(test.record);
  }
  const bool rejected =
      std::any_of(finding.records.begin(), finding.records.end(),
                  [](const TestRecord& r) { return r.outcome == Outcome::reject; });
  if (rejected) finding.draws = std::move(draws);
  return finding;
}

/// Diagnoses of the findings that hold a rejection.
std::vector<Rejection> rejections_of(const TestCase& test_case, const Expectation& expectation,
                                     std::span<const Finding> findings) {
  std::vector<Evidence> rejected;
  for (const Finding& finding : findings) {
    if (finding.draws) rejected.push_back({finding.records, &*finding.draws, &finding.inspection});
  }
  return diagnose(test_case, expectation, rejected);
}

}  // namespace

GateResult run_sequential_gate(std::span<const TestCase> test_cases, const GateOptions& options,
                               const Progress& progress) {
  if (progress) progress("gate", 0.0);
  std::size_t instances = 0;
  for (const TestCase& test_case : test_cases) instances += test_case.instances.size();
  const std::size_t family = std::max<std::size_t>(instances, options.family);
  const double enough = -std::log10(options.family_alpha / static_cast<double>(family));
  std::vector<std::vector<TestRecord>> records(test_cases.size());
  std::vector<std::vector<Rejection>> rejections(test_cases.size());
  std::mutex mutex;
  std::size_t done = 0;
  parallel_for(test_cases.size(), [&](std::size_t i) {
    const TestCase& test_case = test_cases[i];
    const auto purpose = [&] { return "the sequential gate over " + test_case.map; };
    with_memory_for(purpose, [&] {
      const std::shared_ptr<const Expectation> expectation = test_case.expectation();
      std::vector<Finding> findings(test_case.instances.size());
      parallel_for(test_case.instances.size(), [&](std::size_t k) {
        const TestRun run{&test_case, &test_case.instances[k], options.seed};
        findings[k] = watch(run, *expectation, options, enough);
        const std::lock_guard lock(mutex);
        ++done;
        if (progress) progress("gate", static_cast<double>(done) / static_cast<double>(instances));
      });
      rejections[i] = rejections_of(test_case, *expectation, findings);
      for (Finding& finding : findings) {
        std::move(finding.records.begin(), finding.records.end(), std::back_inserter(records[i]));
      }
    });
  });
  GateResult result{options.family_alpha, options.samples, options.seed, {}, {}};
  result.family = family;
  result.sequential = true;
  result.must_detect = options.must_detect;
  for (std::size_t i = 0; i < test_cases.size(); ++i) {
    std::move(records[i].begin(), records[i].end(), std::back_inserter(result.tests));
    std::move(rejections[i].begin(), rejections[i].end(), std::back_inserter(result.rejections));
  }
  return result;
}

}  // namespace lightproof
