#include "lightproof/self_test/power.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <tuple>

#include "lightproof/self_test/displaced_trial.h"
#include "lightproof/self_test/replicates.h"
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
  add_fit(TestId::texels, serpentine(declared.masses.grid()), serpentine(trial.drawn));
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

/// How often each test rejected at kPowerLevel.
struct RejectionCounts {
  std::vector<std::uint64_t> by_test = std::vector<std::uint64_t>(kValuesOf<TestId>);

  void add(const std::vector<Measured>& tests) {
    for (const Measured& measured : tests) {
      const std::optional<double>& log10_p = measured.record.log10_p;
      const bool rejected = log10_p && *log10_p < std::log10(kPowerLevel);
      by_test[static_cast<std::size_t>(measured.record.test)] += rejected ? 1 : 0;
    }
  }
  void merge(const RejectionCounts& other) {
    for (std::size_t test = 0; test < by_test.size(); ++test) by_test[test] += other.by_test[test];
  }
  static auto fields(auto& counts) { return std::tie(counts.by_test); }
};

}  // namespace

std::vector<PowerRecord> measure_power(const PowerOptions& options, const Progress& progress,
                                       const Communicator& communicator) {
  constexpr double kEffect = 0.15;
  constexpr std::array<std::uint64_t, 7> kLadder = {512, 1024, 2048, 3072, 4096, 6144, 8192};
  const Trial trial = trial_off_by(kEffect, distance_of_bins);
  std::vector<Replicates<RejectionCounts>> steps;
  for (std::size_t step = 0; step < kLadder.size(); ++step) {
    steps.push_back({fmt::format("power/{}", step), options.replicates, [&, step] {
                       return [&, step](std::uint64_t i, RejectionCounts& counts) {
                         // Other numbers for every point, and others than the calibration's.
                         const std::uint64_t seed = options.seed + (step + 1) * 1000003 + i;
                         counts.add(run_once(trial, kLadder[step], seed));
                       };
                     }});
  }
  const std::vector<RejectionCounts> counts =
      compute_replicates<RejectionCounts>(steps, progress, communicator);
  std::vector<PowerRecord> all;
  for (std::size_t step = 0; step < kLadder.size(); ++step) {
    for (PowerRecord record : predictions(trial, kLadder[step])) {
      record.replicates = options.replicates;
      record.rejected = counts[step].by_test[static_cast<std::size_t>(record.test)];
      all.push_back(record);
    }
  }
  return all;
}

}  // namespace lightproof
