#include "lightproof/suite/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>

#include "lightproof/core/parallel.h"
#include "lightproof/stats/family.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/stats/tails.h"
#include "lightproof/stats/uniformity.h"
#include "lightproof/suite/configuration.h"
#include "lightproof/suite/gate.h"
#include "lightproof/suite/law_sampler.h"
#include "lightproof/suite/sequential_gate.h"
#include "lightproof/warp/lat_long.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

constexpr TargetDensity kTarget = {Weighting::B, kRec709};

/// A law whose bins are all likely enough to be tested alone, and a sampler of masses that may be
/// another's.
struct Trial {
  std::shared_ptr<const Expectation> expectation;
  Grid<double> drawn;  ///< masses of texels
  OwnDensity own;
  Problem problem;

  Trial(const EnvironmentMap& map, Grid<double> masses)
      : expectation(std::make_shared<const Expectation>(expectation_of(map, kTarget))),
        drawn(std::move(masses)) {
    const auto sampler =
        std::make_shared<const BoundSampler>(bound(LawSampler(drawn, Weighting::B)));
    own = integrate_pdf(*sampler, drawn.extent());
    problem = {map.name,
               to_string(kTarget.weighting),
               "",
               [shared = expectation] { return *shared; },
               [] { return std::vector<Alternative>(); },
               {{"oracle", false, [sampler] { return *sampler; }}}};
  }
};

/// Every bin likely enough to be tested alone, and nothing alike in either direction.
EnvironmentMap calibration_map() {
  EnvironmentMap map = {"calibration", Grid<Rgb>({48, 24}), {}};
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 48; ++x) {
      map.radiance(x, y) =
          Rgb(static_cast<float>((1.0 + y / 12.0) * (1.0 + 0.5 * sin_theta(x / 48.0))));
    }
  }
  return map;
}

Trial sound_trial() {
  const EnvironmentMap map = calibration_map();
  return {map, reference::texel_masses(map, kTarget)};
}

/// The first stage's tests of fresh samples.
std::vector<Measured> run_once(const Trial& trial, std::uint64_t samples, std::uint64_t seed) {
  const Configuration configuration{&trial.problem, &trial.problem.candidates[0], seed};
  const BoundSampler sampler = configuration.candidate->bind();
  const Draws draws =
      draw_samples(sampler, *trial.expectation, configuration.stream("draws"), {0, samples});
  const UniformEstimates uniform =
      draw_uniformly(*trial.expectation, RandomStream("self-test/uniform", seed), samples);
  return test_draws(configuration, *trial.expectation, trial.own, draws, uniform);
}

std::string name_of(const TestRecord& record) { return record.oracle + "/" + record.test; }

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

CalibrationRecord record_of_p_values(const std::string& test, std::vector<double> p_values) {
  std::sort(p_values.begin(), p_values.end());
  CalibrationRecord record;
  record.test = test;
  // Bonferroni over cells.
  record.is_bound = test.find("/worst ") != std::string::npos;
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

/// Runs body(0) … body(count-1) in parallel and tells how far it is.
template <class Body>
void for_each_replicate(std::uint64_t count, const Progress& progress, const Body& body) {
  std::mutex mutex;
  std::uint64_t done = 0;
  parallel_for(count, [&](std::size_t i) {
    body(i);
    if (!progress) return;
    const std::lock_guard lock(mutex);
    if (++done % 64 == 0) {
      progress("self-test", static_cast<double>(done) / static_cast<double>(count));
    }
  });
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
                           options.suspicious, 1.0};
    const GateResult result = run_gate({&trial.problem, 1}, gate);
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
    const GateResult result = run_sequential_gate({&trial.problem, 1}, gate);
    rejected[i] = overall_outcome(result, true) == Outcome::reject ? 1 : 0;
  });
  const auto count = std::count(rejected.begin(), rejected.end(), 1);
  return {"the sequential gate, stopped when it likes", options.family_alpha, options.runs,
          static_cast<std::uint64_t>(count), true};
}

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
  return effect_on(reference::bin_masses(declared, kTarget.weighting, kGateBins).values(),
                   reference::bin_masses(drawn, kTarget.weighting, kGateBins).values());
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
  const Grid<double> declared = reference::texel_masses(map, kTarget);
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
  const auto bins = reference::bin_masses(trial.drawn, kTarget.weighting, kGateBins);
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

CalibrationResult calibrate(const CalibrationOptions& options, const Progress& progress) {
  const Trial trial = sound_trial();
  std::vector<std::vector<Measured>> replicates(options.replicates);
  for_each_replicate(options.replicates, part_of(progress, 0.0, 0.5), [&](std::size_t i) {
    replicates[i] = run_once(trial, options.samples, options.seed + i);
  });
  std::map<std::string, std::vector<double>> p_values;
  for (const std::vector<Measured>& tests : replicates) {
    for (const auto& [record, detectable] : tests) {
      if (record.log10_p) p_values[name_of(record)].push_back(std::pow(10.0, *record.log10_p));
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
