#include "lightproof/gate/sequential_gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "lightproof/gate/by_run.h"
#include "lightproof/gate/expectations.h"
#include "lightproof/gate/judged_runs.h"
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

  /// The evidence of all samples so far; infinite once one lies where none can.
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

/// The records of one run, and what a diagnosis would need of it.
struct Finding {
  std::vector<TestRecord> records;
  DrawnRun drawn;
};

std::size_t count_runs(std::span<const TestCase> test_cases) {
  std::size_t count = 0;
  for (const TestCase& test_case : test_cases) count += test_case.instances.size();
  return count;
}

/// Draws until the evidence reaches `enough` (log10), or to the end.
Finding watch_answering(const TestRun& run, const Expectation& expectation,
                        const GateOptions& options, double enough) {
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
    record.effect = cressie_read(draws.bins, expectation.bins, draws.samples).effect;
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
  Finding finding{{record}, {std::move(draws), inspection}};
  for (const auto& tests :
       {test_validity(run, finding.drawn.draws),
        test_exactly(run, expectation, sampler, inspection, finding.drawn.draws,
                     reference_implementation ? &*reference_implementation : nullptr)}) {
    for (const Measured& test : tests) finding.records.push_back(test.record);
  }
  return finding;
}

Finding watch(const TestRun& run, const Expectation& expectation, const GateOptions& options,
              double enough) {
  try {
    return watch_answering(run, expectation, options, enough);
  } catch (const SamplerFailure& failure) {
    Finding finding{{},
                    {Draws(expectation.masses.extent(), expectation.bands.size()), Inspection{}}};
    for (const Measured& test : test_unanswered(run, failure, options.samples)) {
      finding.records.push_back(test.record);
    }
    return finding;
  }
}

/// Test cases, and what was kept of their runs.
class SequentialRun {
 public:
  SequentialRun(std::span<const TestCase> test_cases, const GateOptions& options,
                const Communicator& communicator)
      : test_cases_(test_cases),
        options_(options),
        communicator_(communicator),
        family_(std::max<std::uint64_t>(count_runs(test_cases), options.family)),
        enough_(-std::log10(options.family_alpha / static_cast<double>(family_))),
        expectations_(test_cases),
        kept_(test_cases) {}

  GateResult operator()(const Progress& progress) {
    if (progress) progress("gate", 0.0);
    ByRun<std::vector<TestRecord>> records = watch_all(progress);
    GateResult result{options_.family_alpha, options_.samples, options_.seed, {}, {}};
    result.family = family_;
    result.sequential = true;
    result.must_detect = options_.must_detect;
    const auto drawn = [this](RunIndex at, const Expectation& expectation) {
      return kept_[at] ? *std::move(kept_[at])
                       : watch(run_at(at), expectation, options_, enough_).drawn;
    };
    add_judged(result, {test_cases_, options_.seed, records, drawn}, expectations_, communicator_);
    return result;
  }

 private:
  TestRun run_at(RunIndex at) const { return at.in(test_cases_, options_.seed); }

  /// What is rejected keeps what it drew, unless its map is large: it is drawn again then.
  std::vector<TestRecord> records_of(const TestRun& run, const Expectation& expectation,
                                     std::optional<DrawnRun>& kept) const {
    Finding finding = watch(run, expectation, options_, enough_);
    if (is_any_rejected(finding.records) && !run.test_case->is_large()) {
      kept = std::move(finding.drawn);
    }
    return std::move(finding.records);
  }

  ByRun<std::vector<TestRecord>> watch_all(const Progress& progress) {
    using Shared = std::shared_ptr<const Expectation>;
    using OfRun = std::vector<TestRecord>;
    std::vector<WorkGroup<Shared, OfRun>> groups(test_cases_.size());
    kept_.for_each([&](RunIndex at, std::optional<DrawnRun>& kept) {
      const TestRun run = run_at(at);
      groups[at.test_case].one_at_a_time = run.test_case->is_large();
      groups[at.test_case].prepare = [this, at] { return expectations_.of(at.test_case); };
      groups[at.test_case].cells.push_back(
          {run.key("sequential"), [this, run, &kept](const Shared& expectation) {
             return with_memory_for_gate(*run.test_case, run.instance->name,
                                         [&] { return records_of(run, *expectation, kept); });
           }});
    });
    auto results = gather(compute_groups<Shared, OfRun>(groups, communicator_.share, progress,
                                                        "gate", communicator_.kept),
                          communicator_);
    ByRun<OfRun> records(test_cases_);
    records.for_each([&](RunIndex at, OfRun& of_run) {
      of_run = std::move(results.at(run_at(at).key("sequential")));
    });
    return records;
  }

  std::span<const TestCase> test_cases_;
  const GateOptions& options_;
  const Communicator& communicator_;
  std::uint64_t family_;  ///< instances that share the error probability
  double enough_;         ///< log10 of the evidence that rejects
  Expectations expectations_;
  ByRun<std::optional<DrawnRun>> kept_;  ///< of what is rejected
};

}  // namespace

GateResult run_sequential_gate(std::span<const TestCase> test_cases, const GateOptions& options,
                               const Progress& progress, const Communicator& communicator) {
  return SequentialRun(test_cases, options, communicator)(progress);
}

}  // namespace lightproof
