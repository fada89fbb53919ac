#include "lightproof/suite/power.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/uniformity.h"
#include "lightproof/suite/gate.h"
#include "lightproof/suite/sequential_gate.h"
#include "lightproof/suite/trial.h"
#include "lightproof/warp/lat_long.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

/// The effect w of a law on cells that are tested for another one.
double effect_on(std::span<const double> declared, std::span<const double> drawn) {
  double square = 0.0;
  for (std::size_t i = 0; i < declared.size(); ++i) {
    square += (drawn[i] - declared[i]) * (drawn[i] - declared[i]) / declared[i];
  }
  return std::sqrt(square);
}

/// How far a law is from the declared one, in the terms of some test; in proportion to the share
/// that is mixed in.
using LawDistance = double (*)(const Grid<double>& declared, const Grid<double>& drawn);

double distance_of_bins(const Grid<double>& declared, const Grid<double>& drawn) {
  return effect_on(reference::bin_masses(declared, kTrialTarget.weighting, kGateBins).values(),
                   reference::bin_masses(drawn, kTrialTarget.weighting, kGateBins).values());
}

double distance_of_texels(const Grid<double>& declared, const Grid<double>& drawn) {
  return effect_on(declared.values(), drawn.values());
}

double distance_of_rows(const Grid<double>& declared, const Grid<double>& drawn) {
  return effect_on(reference::row_marginal(declared), reference::row_marginal(drawn));
}

double distance_of_columns(const Grid<double>& declared, const Grid<double>& drawn) {
  return effect_on(reference::column_marginal(declared), reference::column_marginal(drawn));
}

/// The declared law with so much of another one, uniform but for two thirds of it on one side, that
/// it is off by `effect`.
Trial trial_off_by(double effect, LawDistance distance) {
  const EnvironmentMap map = calibration_map();
  const Grid<double> declared = reference::texel_masses(map, kTrialTarget);
  Grid<double> other(declared.extent());
  for (int y = 0; y < other.extent().height; ++y) {
    for (int x = 0; x < other.extent().width; ++x) {
      const double side = 2 * x < other.extent().width ? 4.0 / 3.0 : 2.0 / 3.0;
      other(x, y) = side * texel_solid_angle(other.extent(), y) / kSphere;
    }
  }
  const double share = effect / distance(declared, other);
  for (std::size_t i = 0; i < other.values().size(); ++i) {
    other.values()[i] = (1.0 - share) * declared.values()[i] + share * other.values()[i];
  }
  return {map, std::move(other)};
}

/// The declared law, with weights that are too large by these factors, in columns by turns.
Trial trial_of_weights(double even, double odd) {
  Trial trial = sound_trial();
  const BoundSampler sound = trial.problem.candidates[0].bind();
  trial.problem.candidates[0].bind = [sound, even, odd] {
    return BoundSampler{[sound, even, odd](auto points, auto samples) {
                          sound.sample(points, samples);
                          for (TexelSample& sample : samples) {
                            sample.pdf.value /= sample.x % 2 == 0 ? even : odd;
                          }
                        },
                        sound.pdf};
  };
  return trial;
}

/// Distances between the laws of a transformed coordinate that is uniform if `declared` is drawn.
struct TransformedDistance {
  double kuiper = 0.0;
  double anderson = 0.0;
};

TransformedDistance transformed_distance(std::span<const double> declared,
                                         std::span<const double> actual) {
  TransformedDistance distance;
  double above = 0.0;
  double below = 0.0;
  double p = 0.0;
  double q = 0.0;
  double square = 0.0;
  constexpr int kSteps = 1000;  // midpoints in every cell, where both are linear
  for (std::size_t i = 0; i < declared.size(); ++i) {
    for (int k = 0; k < kSteps; ++k) {
      const double share = (k + 0.5) / kSteps;
      const double u = p + share * declared[i];
      const double d = q + share * actual[i] - u;
      square += d * d / (u * (1.0 - u)) * declared[i] / kSteps;
    }
    p += declared[i];
    q += actual[i];
    above = std::max(above, q - p);
    below = std::max(below, p - q);
  }
  return {above + below, std::sqrt(square)};
}

double distance_of_phi(const Grid<double>& declared, const Grid<double>& drawn) {
  return transformed_distance(reference::column_marginal(declared),
                              reference::column_marginal(drawn))
      .kuiper;
}

double distance_of_theta(const Grid<double>& declared, const Grid<double>& drawn) {
  return transformed_distance(reference::row_marginal(declared), reference::row_marginal(drawn))
      .anderson;
}

constexpr double kPowerLevel = 1e-3;

/// What the tests of a trial's counts should reject, and how far the law is off in their terms.
std::vector<PowerRecord> predictions(const Trial& trial, std::uint64_t samples) {
  const Expectation& declared = *trial.expectation;
  const auto rows = reference::row_marginal(trial.drawn);
  const auto columns = reference::column_marginal(trial.drawn);
  const auto bins = reference::bin_masses(trial.drawn, kTrialTarget.weighting, kGateBins);
  std::vector<PowerRecord> records;
  const auto add_fit = [&](std::string test, std::span<const double> p, std::span<const double> q) {
    records.push_back({std::move(test), effect_on(p, q), kPowerLevel, samples, 0, 0,
                       fit_power(p, q, kPowerLevel, samples), false});
  };
  add_fit("reference/bins 16x32", serpentine(declared.bins), serpentine(bins));
  add_fit("reference/texels", serpentine(declared.masses), serpentine(trial.drawn));
  add_fit("reference/rows", declared.rows, rows);
  add_fit("reference/columns", declared.columns, columns);
  const auto n = static_cast<double>(samples);
  const double phi = transformed_distance(declared.columns, columns).kuiper;
  records.push_back({"reference/phi (Kuiper)", phi, kPowerLevel, samples, 0, 0,
                     kuiper_power(phi, kPowerLevel, n), true});
  const double theta = transformed_distance(declared.rows, rows).anderson;
  records.push_back({"reference/theta (Anderson-Darling)", theta, kPowerLevel, samples, 0, 0,
                     anderson_darling_power(theta, kPowerLevel, n), true});
  return records;
}

void count_rejections(PowerRecord& record, const std::vector<std::vector<Measured>>& replicates) {
  record.replicates = replicates.size();
  for (const auto& tests : replicates) {
    for (const auto& [test, detectable] : tests) {
      if (name_of(test) != record.test || !test.log10_p) continue;
      record.rejected += *test.log10_p < std::log10(record.level) ? 1 : 0;
    }
  }
}

}  // namespace

std::vector<PowerRecord> measure_printed_effects(const PowerOptions& options,
                                                 const Progress& progress) {
  constexpr std::uint64_t kSamples = std::uint64_t{1} << 14U;
  const Trial sound = sound_trial();
  const auto run = [&](const Trial& trial, std::uint64_t seed, bool sequential) {
    const GateOptions gate{kSamples, seed};
    return sequential ? run_sequential_gate({&trial.problem, 1}, gate)
                      : run_gate({&trial.problem, 1}, gate);
  };
  const auto record_in = [](const GateResult& result, std::string_view test) {
    return *std::find_if(result.tests.begin(), result.tests.end(),
                         [&](const TestRecord& r) { return name_of(r) == test; });
  };
  struct Plant {
    std::string test;
    std::function<Trial(double effect)> make;
    bool sequential = false;
  };
  const auto off_by = [](LawDistance distance) {
    return [distance](double effect) { return trial_off_by(effect, distance); };
  };
  const auto scaled = [](double effect) { return trial_of_weights(1.0 + effect, 1.0 + effect); };
  // A variance more by w of weights that are (1 + d) and (1 - d) times the right ones.
  const auto noisy = [&](double effect) {
    const reference::EstimatorMoments& exact = sound.expectation->estimators[1];
    const double d = std::sqrt(effect * exact.variance() / exact.raw[1]);
    return trial_of_weights(1.0 + d, 1.0 - d);
  };
  const std::vector<Plant> plants = {
      {"reference/bins 16x32", off_by(distance_of_bins)},
      {"reference/texels", off_by(distance_of_texels)},
      {"reference/rows", off_by(distance_of_rows)},
      {"reference/columns", off_by(distance_of_columns)},
      {"reference/phi (Kuiper)", off_by(distance_of_phi)},
      {"reference/theta (Anderson-Darling)", off_by(distance_of_theta)},
      {"reference/sequential", off_by(distance_of_bins), true},
      {"mean/irradiance, normal +x", scaled},
      {"mean/irradiance, normal +x, against uniform", scaled},
      {"variance/irradiance, normal +x", noisy}};
  std::vector<PowerRecord> records;
  for (std::size_t k = 0; k < plants.size(); ++k) {
    const Plant& plant = plants[k];
    const double effect =
        *record_in(run(sound, options.seed, plant.sequential), plant.test).detectable_effect;
    const Trial trial = plant.make(effect);
    std::vector<char> rejected(options.replicates);
    const auto parts = static_cast<double>(plants.size());
    for_each_replicate(
        options.replicates,
        part_of(progress, static_cast<double>(k) / parts, static_cast<double>(k + 1) / parts),
        [&](std::size_t i) {
          const GateResult result = run(trial, options.seed + i, plant.sequential);
          rejected[i] = record_in(result, plant.test).outcome == Outcome::reject ? 1 : 0;
        });
    records.push_back({plant.test, effect, GateOptions{}.family_alpha, kSamples, options.replicates,
                       static_cast<std::uint64_t>(std::count(rejected.begin(), rejected.end(), 1)),
                       kDetectablePower, true});
  }
  return records;
}

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
      all.push_back(std::move(record));
    }
  }
  return all;
}

}  // namespace lightproof
