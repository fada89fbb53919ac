#include "lightproof/self_test/calibration.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "lightproof/gate/gate.h"
#include "lightproof/gate/sequential_gate.h"
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

/// Each replicate taken for a whole run of one stage.
FamilyRecord family_of_replicates(const std::vector<std::vector<Measured>>& replicates,
                                  double alpha) {
  FamilyRecord family{"one stage, Holm", alpha, replicates.size(), 0};
  for (const std::vector<Measured>& tests : replicates) {
    std::vector<double> log10_p;
    for (const Measured& test : tests) {
      if (test.record.log10_p) log10_p.push_back(*test.record.log10_p);
    }
    const std::vector<bool> rejected = holm_rejections(log10_p, alpha);
    family.rejected += std::count(rejected.begin(), rejected.end(), true) > 0 ? 1 : 0;
  }
  return family;
}

FamilyRecord family_of_gate(const Trial& trial, const CalibrationOptions& options,
                            const Progress& progress) {
  std::vector<char> rejected(options.runs);
  for_each_replicate(options.runs, progress, [&](std::size_t i) {
    const GateOptions gate{options.run_samples, options.seed + i, options.family_alpha,
                           options.screening_level, 1.0};
    const GateResult result = run_gate({&trial.test_case, 1}, gate);
    rejected[i] = overall_outcome(result, true) == Outcome::reject ? 1 : 0;
  });
  const auto count = std::count(rejected.begin(), rejected.end(), 1);
  return {"the gate, two stages", options.family_alpha, options.runs,
          static_cast<std::uint64_t>(count)};
}

FamilyRecord family_of_sequential_gate(const Trial& trial, const CalibrationOptions& options,
                                       const Progress& progress) {
  std::vector<char> rejected(options.runs);
  for_each_replicate(options.runs, progress, [&](std::size_t i) {
    const GateOptions gate{options.run_samples, options.seed + i, options.family_alpha};
    const GateResult result = run_sequential_gate({&trial.test_case, 1}, gate);
    rejected[i] = overall_outcome(result, true) == Outcome::reject ? 1 : 0;
  });
  const auto count = std::count(rejected.begin(), rejected.end(), 1);
  return {"the sequential gate, stopped when it likes", options.family_alpha, options.runs,
          static_cast<std::uint64_t>(count), true};
}

}  // namespace

CalibrationResult calibrate(const CalibrationOptions& options, const Progress& progress) {
  const Trial trial = correct_trial();
  std::vector<std::vector<Measured>> replicates(options.replicates);
  for_each_replicate(options.replicates, part_of(progress, 0.0, 0.5), [&](std::size_t i) {
    replicates[i] = run_once(trial, options.samples, options.seed + i);
  });
  std::map<TestId, std::vector<double>> p_values;
  for (const std::vector<Measured>& tests : replicates) {
    for (const Measured& measured : tests) {
      const TestRecord& record = measured.record;
      if (record.log10_p) p_values[record.test].push_back(std::pow(10.0, *record.log10_p));
    }
  }
  CalibrationResult result;
  for (auto& [test, values] : p_values) {
    result.tests.push_back(record_of_p_values(test, std::move(values)));
  }
  result.families = {family_of_replicates(replicates, options.family_alpha),
                     family_of_gate(trial, options, part_of(progress, 0.5, 0.8)),
                     family_of_sequential_gate(trial, options, part_of(progress, 0.8, 1.0))};
  return result;
}

}  // namespace lightproof
