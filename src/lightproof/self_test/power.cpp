#include "lightproof/self_test/power.h"

#include <algorithm>
#include <cmath>

#include "lightproof/self_test/displaced_trial.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/uniformity.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

constexpr double kPowerLevel = 1e-3;

/// What the tests of a trial's counts should reject, and how far the distribution is off in their
/// terms.
std::vector<PowerRecord> predictions(const Trial& trial, std::uint64_t samples) {
  const Expectation& declared = *trial.expectation;
  const auto rows = reference::row_marginal(trial.drawn);
  const auto columns = reference::column_marginal(trial.drawn);
  const auto bins = reference::bin_masses(trial.drawn, kTrialTarget.density_space, kGateBins);
  std::vector<PowerRecord> records;
  const auto add_fit = [&](TestId test, std::span<const double> p, std::span<const double> q) {
    records.push_back({test, effect_on(p, q), kPowerLevel, samples, 0, 0,
                       fit_power(p, q, kPowerLevel, samples), false});
  };
  add_fit(TestId::bins, serpentine(declared.bins), serpentine(bins));
  add_fit(TestId::texels, serpentine(declared.masses), serpentine(trial.drawn));
  add_fit(TestId::rows, declared.rows, rows);
  add_fit(TestId::columns, declared.columns, columns);
  const auto n = static_cast<double>(samples);
  const double phi = transformed_distance(declared.columns, columns).kuiper;
  records.push_back(
      {TestId::phi, phi, kPowerLevel, samples, 0, 0, kuiper_power(phi, kPowerLevel, n), true});
  const double theta = transformed_distance(declared.rows, rows).anderson;
  records.push_back({TestId::theta, theta, kPowerLevel, samples, 0, 0,
                     anderson_darling_power(theta, kPowerLevel, n), true});
  return records;
}

void count_rejections(PowerRecord& record, const std::vector<std::vector<Measured>>& replicates) {
  record.replicates = replicates.size();
  for (const auto& tests : replicates) {
    for (const Measured& measured : tests) {
      const TestRecord& test = measured.record;
      if (test.test != record.test || !test.log10_p) continue;
      record.rejected += *test.log10_p < std::log10(record.level) ? 1 : 0;
    }
  }
}

}  // namespace

std::vector<PowerRecord> measure_power(const PowerOptions& options, const Progress& progress) {
  constexpr double kEffect = 0.15;
  const std::vector<std::uint64_t> ladder = {512, 1024, 2048, 3072, 4096, 6144, 8192};
  const Trial trial = trial_off_by(kEffect, distance_of_bins);
  std::vector<PowerRecord> all;
  for (std::size_t step = 0; step < ladder.size(); ++step) {
    const std::uint64_t samples = ladder[step];
    std::vector<std::vector<Measured>> replicates(options.replicates);
    const auto steps = static_cast<double>(ladder.size());
    for_each_replicate(
        options.replicates,
        part_of(progress, static_cast<double>(step) / steps, static_cast<double>(step + 1) / steps),
        [&](std::size_t i) {
          // Other numbers for every point, and others than the calibration's.
          const std::uint64_t seed = options.seed + (step + 1) * 1000003 + i;
          replicates[i] = run_once(trial, samples, seed);
        });
    for (PowerRecord record : predictions(trial, samples)) {
      count_rejections(record, replicates);
      all.push_back(record);
    }
  }
  return all;
}

}  // namespace lightproof
