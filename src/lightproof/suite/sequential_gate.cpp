#include "lightproof/suite/sequential_gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "lightproof/core/out_of_memory.h"
#include "lightproof/core/parallel.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/sequential.h"
#include "lightproof/suite/configuration.h"
#include "lightproof/suite/diagnosis.h"
#include "lightproof/suite/records.h"

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

/// The e-processes of one law.
class EProcesses {
 public:
  explicit EProcesses(const Expectation& expectation)
      : bins_(expectation.bins.values()), rows_(expectation.rows), columns_(expectation.columns) {
    const auto texels = expectation.masses.values();
    if (texels.size() <= kMostCells) texels_.emplace(texels);
  }

  /// Of all samples so far; infinite once one lies where none can.
  double log10_e(const Draws& draws) const {
    if (draws.lost.count > 0 || draws.dark.count > 0) return INFINITY;
    std::vector<double> all = {bins_.log10_e(draws.bins.values()),
                               rows_.log10_e(row_counts(draws.texels)),
                               columns_.log10_e(column_counts(draws.texels))};
    if (texels_) all.push_back(texels_->log10_e(draws.texels.values()));
    return log10_average(all);
  }

  /// The effect on the bins that would be known for wrong after so many samples.
  double detectable_effect(double log10_enough, std::uint64_t samples) const {
    const double processes = texels_ ? 4.0 : 3.0;
    return bins_.detectable_effect(std::pow(10.0, -log10_enough) / processes, kDetectablePower,
                                   static_cast<double>(samples));
  }

 private:
  SequentialTest bins_;
  SequentialTest rows_;
  SequentialTest columns_;
  std::optional<SequentialTest> texels_;
};

/// The records of one candidate, and what a diagnosis needs of it.
struct Finding {
  std::vector<TestRecord> records;
  Inspection inspection;
  std::optional<Draws> draws;  ///< there if a record is rejected
};

/// Draws until the evidence reaches `enough` (log10), or to the end.
Finding watch(const Configuration& configuration, const Expectation& expectation,
              const GateOptions& options, double enough) {
  const BoundSampler sampler = configuration.candidate->bind();
  const EProcesses evidence(expectation);
  const RandomStream stream = configuration.stream("sequential");
  Draws draws(expectation.masses.extent(), expectation.bands.size());
  double log10_e = 0.0;
  for (std::uint64_t next = kFirstLook; log10_e < enough && draws.samples < options.samples;
       next += next / 2) {
    const std::uint64_t target = std::min(next, options.samples);
    const Draws more =
        draw_samples(sampler, expectation, stream, {draws.samples, target - draws.samples});
    draws.merge(more);
    log10_e = evidence.log10_e(draws);
  }
  TestRecord record = record_of(configuration, "reference", kSequentialTest, draws.samples);
  record.statistic = log10_e;
  record.log10_p = std::min(0.0, -log10_e);
  record.outcome = log10_e >= enough ? Outcome::reject : Outcome::accept;
  const auto failure = failure_of([&] {
    const double detectable = evidence.detectable_effect(enough, options.samples);
    if (std::isfinite(detectable)) record.detectable_effect = detectable;
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
  const Inspection inspection =
      configuration.candidate->inspect(sampler, expectation, configuration.candidate->rounding);
  const std::optional<BoundSampler> twin = configuration.candidate->has_twin
                                               ? std::optional(configuration.problem->twin())
                                               : std::nullopt;
  Finding finding{{record}, inspection, {}};
  for (const auto& tests : {test_strays(configuration, draws),
                            test_exactly(configuration, expectation, sampler, inspection, draws,
                                         twin ? &*twin : nullptr)}) {
    for (const Measured& test : tests) finding.records.push_back(test.record);
  }
  const bool rejected =
      std::any_of(finding.records.begin(), finding.records.end(),
                  [](const TestRecord& r) { return r.outcome == Outcome::reject; });
  if (rejected) finding.draws = std::move(draws);
  return finding;
}

/// Diagnoses of the findings that hold a rejection.
std::vector<Rejection> rejections_of(const Problem& problem, const Expectation& expectation,
                                     std::span<const Finding> findings) {
  std::vector<Evidence> rejected;
  for (const Finding& finding : findings) {
    if (finding.draws) rejected.push_back({finding.records, &*finding.draws, &finding.inspection});
  }
  return diagnose(problem, expectation, rejected);
}

}  // namespace

GateResult run_sequential_gate(std::span<const Problem> problems, const GateOptions& options,
                               const Progress& progress) {
  if (progress) progress("gate", 0.0);
  std::size_t candidates = 0;
  for (const Problem& problem : problems) candidates += problem.candidates.size();
  const std::size_t family = std::max<std::size_t>(candidates, options.family);
  const double enough = -std::log10(options.family_alpha / static_cast<double>(family));
  std::vector<std::vector<TestRecord>> records(problems.size());
  std::vector<std::vector<Rejection>> rejections(problems.size());
  std::mutex mutex;
  std::size_t done = 0;
  parallel_for(problems.size(), [&](std::size_t i) {
    const Problem& problem = problems[i];
    const auto purpose = [&] { return "the sequential gate over " + problem.map; };
    with_memory_for(purpose, [&] {
      const std::shared_ptr<const Expectation> expectation = problem.expectation();
      std::vector<Finding> findings(problem.candidates.size());
      parallel_for(problem.candidates.size(), [&](std::size_t k) {
        const Configuration configuration{&problem, &problem.candidates[k], options.seed};
        findings[k] = watch(configuration, *expectation, options, enough);
        const std::lock_guard lock(mutex);
        ++done;
        if (progress) progress("gate", static_cast<double>(done) / static_cast<double>(candidates));
      });
      rejections[i] = rejections_of(problem, *expectation, findings);
      for (Finding& finding : findings) {
        std::move(finding.records.begin(), finding.records.end(), std::back_inserter(records[i]));
      }
    });
  });
  GateResult result{options.family_alpha, options.samples, options.seed, {}, {}};
  result.family = family;
  result.sequential = true;
  result.must_detect = options.must_detect;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    std::move(records[i].begin(), records[i].end(), std::back_inserter(result.tests));
    std::move(rejections[i].begin(), rejections[i].end(), std::back_inserter(result.rejections));
  }
  return result;
}

}  // namespace lightproof
