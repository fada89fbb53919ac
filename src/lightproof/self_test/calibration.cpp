#include "lightproof/self_test/calibration.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lightproof/gate/gate.h"
#include "lightproof/gate/sequential_gate.h"
#include "lightproof/self_test/replicates.h"
#include "lightproof/self_test/trial.h"
#include "lightproof/stats/family.h"
#include "lightproof/stats/uniformity.h"

namespace lightproof {
namespace {

/// How far sorted numbers are from uniform: above the diagonal (too many small ones) and below it.
struct Distances {
  double above = 0.0;
  double below = 0.0;
};

Distances distances_of(const std::vector<double>& sorted) {
  Distances d;
  const auto n = static_cast<double>(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    d.above = std::max(d.above, static_cast<double>(i + 1) / n - sorted[i]);
    d.below = std::max(d.below, sorted[i] - static_cast<double>(i) / n);
  }
  return d;
}

CalibrationRecord record_of_p_values(TestId test, std::vector<double> p_values) {
  std::sort(p_values.begin(), p_values.end());
  CalibrationRecord record;
  record.test = test;
  record.is_bound = describe(test).p_value_is_bound;
  record.replicates = p_values.size();
  for (std::size_t i = 0; i <= 100; ++i) {
    record.quantiles.push_back(p_values[i * (p_values.size() - 1) / 100]);
  }
  const Distances distances = distances_of(p_values);
  const double root = std::sqrt(static_cast<double>(p_values.size()));
  if (record.is_bound) {
    record.ks_distance = distances.above;
    // exp(-2 n d^2), one-sided (Smirnov 1939).
    record.log10_p_ks = -2.0 * std::pow(root * distances.above, 2) / std::log(10.0);
  } else {
    record.ks_distance = std::max(distances.above, distances.below);
    record.log10_p_ks = log10_kolmogorov_tail(root * record.ks_distance);
    std::vector<std::uint64_t> counts(kUniformCells);
    for (const double p : p_values) {
      ++counts[static_cast<std::size_t>(cell_of(p, static_cast<int>(kUniformCells)))];
    }
    record.log10_p_anderson = anderson_darling_test(counts).log10_p;
  }
  record.below_one_percent = static_cast<std::uint64_t>(
      std::lower_bound(p_values.begin(), p_values.end(), 0.01) - p_values.begin());
  return record;
}

/// What replicates of the first stage's tests found.
struct StageFindings {
  std::vector<std::vector<double>> p_values{kValuesOf<TestId>};  ///< by test
  Count rejected;  ///< replicates that Holm's procedure rejects, each taken for a whole run

  void merge(const StageFindings& other) {
    for (std::size_t test = 0; test < p_values.size(); ++test) {
      p_values[test].insert(p_values[test].end(), other.p_values[test].begin(),
                            other.p_values[test].end());
    }
    rejected.merge(other.rejected);
  }
  static auto fields(auto& findings) { return std::tie(findings.p_values, findings.rejected); }
};

void add(StageFindings& findings, const std::vector<Measured>& tests, double alpha) {
  std::vector<double> log10_p;
  for (const Measured& test : tests) {
    if (!test.record.log10_p) continue;
    log10_p.push_back(*test.record.log10_p);
    findings.p_values[static_cast<std::size_t>(test.record.test)].push_back(
        std::pow(10.0, log10_p.back()));
  }
  const std::vector<bool> rejected = holm_rejections(log10_p, alpha);
  findings.rejected.value += std::count(rejected.begin(), rejected.end(), true) > 0 ? 1 : 0;
}

StageFindings measure_first_stage(const Trial& trial, const CalibrationOptions& options,
                                  const Progress& progress, const Communicator& communicator) {
  const Replicates<StageFindings> replicates = {
      "calibration/p-values", options.replicates, [&] {
        return [&](std::uint64_t i, StageFindings& findings) {
          add(findings, run_once(trial, options.samples, options.seed + i), options.family_alpha);
        };
      }};
  return compute_replicates<StageFindings>({&replicates, 1}, progress, communicator)[0];
}

/// Runs of the gate and of the sequential gate over a correct sampler.
std::vector<FamilyRecord> measure_families(const Trial& trial, const CalibrationOptions& options,
                                           const Progress& progress,
                                           const Communicator& communicator) {
  const auto runs_of = [&](std::string name, GateOptions gate, bool sequential) {
    return Replicates<Count>{
        std::move(name), options.runs, [&trial, gate, sequential] {
          return [&trial, gate, sequential](std::uint64_t i, Count& rejected) {
            GateOptions run = gate;
            run.seed += i;
            const GateResult result = sequential ? run_sequential_gate({&trial.test_case, 1}, run)
                                                 : run_gate({&trial.test_case, 1}, run);
            rejected.value += overall_outcome(result, true) == Outcome::reject ? 1 : 0;
          };
        }};
  };
  const std::vector<Replicates<Count>> runs = {
      runs_of(
          "calibration/gate",
          {options.run_samples, options.seed, options.family_alpha, options.screening_level, 1.0},
          false),
      runs_of("calibration/sequential gate",
              {options.run_samples, options.seed, options.family_alpha}, true)};
  const std::vector<Count> rejected = compute_replicates<Count>(runs, progress, communicator);
  return {{"the gate, two stages", options.family_alpha, options.runs, rejected[0].value},
          {"the sequential gate, stopped when it likes", options.family_alpha, options.runs,
           rejected[1].value, true}};
}

}  // namespace

CalibrationResult calibrate(const CalibrationOptions& options, const Progress& progress,
                            const Communicator& communicator) {
  const Trial trial = correct_trial();
  StageFindings stage =
      measure_first_stage(trial, options, part_of(progress, 0.0, 0.5), communicator);
  CalibrationResult result;
  for (const TestDescription& test : tests()) {
    std::vector<double>& p_values = stage.p_values[static_cast<std::size_t>(test.id)];
    if (!p_values.empty()) result.tests.push_back(record_of_p_values(test.id, std::move(p_values)));
  }
  result.families = {
      {"one stage, Holm", options.family_alpha, options.replicates, stage.rejected.value}};
  for (FamilyRecord& family :
       measure_families(trial, options, part_of(progress, 0.5, 1.0), communicator)) {
    result.families.push_back(std::move(family));
  }
  return result;
}

}  // namespace lightproof
