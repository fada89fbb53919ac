// Every statistic that prints an effect has a defect of that size here.
#include <algorithm>
#include <cmath>
#include <functional>

#include "lightproof/gate/discrete_sampler.h"
#include "lightproof/gate/gate.h"
#include "lightproof/gate/sequential_gate.h"
#include "lightproof/samplers/texel_positions.h"
#include "lightproof/self_test/displaced_trial.h"
#include "lightproof/self_test/power.h"
#include "lightproof/self_test/replicates.h"

namespace lightproof {
namespace {

constexpr std::uint64_t kSamples = std::uint64_t{1} << 14U;

/// A defect as large as an effect of a test.
struct Injection {
  TestId test;
  std::function<Trial(double effect)> make;
  bool sequential = false;
};

/// What a sampler does to the points and the samples of a batch.
struct Changes {
  std::function<void(std::vector<SquarePoint>&)> points = {};
  std::function<void(std::span<const SquarePoint>, std::span<TexelSample>)> samples = {};
};

/// The correct trial, with what changes its points before, or its samples after, they are drawn.
Trial changed_trial(const Changes& changes) {
  Trial trial = correct_trial();
  const BoundSampler correct = trial.test_case.instances[0].bind();
  trial.test_case.instances[0].bind = [correct, changes] {
    return BoundSampler{
        [correct, changes](std::span<const SquarePoint> points, std::span<TexelSample> samples) {
          std::vector<SquarePoint> used(points.begin(), points.end());
          if (changes.points) changes.points(used);
          correct.sample(used, samples);
          if (changes.samples) changes.samples(points, samples);
        },
        correct.pdf};
  };
  return trial;
}

/// Weights that are too large by these factors, in columns by turns.
Trial trial_of_weights(double even, double odd) {
  return changed_trial({.samples = [even, odd](auto, std::span<TexelSample> samples) {
    for (TexelSample& sample : samples) sample.pdf.value /= sample.x % 2 == 0 ? even : odd;
  }});
}

double fraction_of(double x) { return x - std::floor(x); }

/// Digits of a point that say nothing of where it lies, as a number in [0, 1).
double digits_of(SquarePoint u) { return fraction_of(u.t * 0x1p24); }

/// Whether this point's sample is one of a share.
bool is_chosen(SquarePoint u, double share) { return digits_of(u) < share; }

/// The likeliest of some cells drawn more often by this factor, the others less.
template <class CellOf>
Trial trial_of_excess(double effect, std::span<const double> cells, const CellOf& cell_of_texel) {
  const EnvironmentMap map = calibration_map();
  Grid<double> drawn = correct_trial().drawn;
  const auto likeliest =
      static_cast<std::size_t>(std::max_element(cells.begin(), cells.end()) - cells.begin());
  const double mass = cells[likeliest];
  const double less = (1.0 - mass * (1.0 + effect)) / (1.0 - mass);
  for (int y = 0; y < drawn.extent().height; ++y) {
    for (int x = 0; x < drawn.extent().width; ++x) {
      drawn(x, y) *= cell_of_texel(x, y) == likeliest ? 1.0 + effect : less;
    }
  }
  return {map, std::move(drawn)};
}

std::vector<Injection> injections_of_cells() {
  const auto off_by = [](DistributionDistance distance) {
    return [distance](double effect) { return trial_off_by(effect, distance); };
  };
  const auto width = static_cast<std::size_t>(calibration_map().radiance.extent().width);
  return {{TestId::bins, off_by(distance_of_bins)},
          {TestId::texels, off_by(distance_of_texels)},
          {TestId::rows, off_by(distance_of_rows)},
          {TestId::columns, off_by(distance_of_columns)},
          {TestId::phi, off_by(distance_of_phi)},
          {TestId::theta, off_by(distance_of_theta)},
          {TestId::sequential, off_by(distance_of_bins), true},
          {TestId::two_samples, off_by(distance_of_bins)},
          {TestId::own_pdf_bins,
           [](double effect) {
             // The pdf is the declared distribution's, and so are the bins that it integrates to.
             Trial trial = trial_off_by(effect, distance_of_bins);
             const BoundSampler drawn = trial.test_case.instances[0].bind();
             const BoundSampler declared = correct_trial().test_case.instances[0].bind();
             trial.test_case.instances[0].bind = [drawn, declared] {
               return BoundSampler{drawn.sample, declared.pdf};
             };
             return trial;
           }},
          {TestId::worst_texel,
           [width](double effect) {
             const Trial correct = correct_trial();
             return trial_of_excess(
                 effect, correct.expectation->masses.values(), [width](int x, int y) {
                   return static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
                 });
           }},
          {TestId::worst_row,
           [](double effect) {
             const Trial correct = correct_trial();
             return trial_of_excess(effect, correct.expectation->rows,
                                    [](int, int y) { return static_cast<std::size_t>(y); });
           }},
          {TestId::worst_column, [](double effect) {
             const Trial correct = correct_trial();
             return trial_of_excess(effect, correct.expectation->columns,
                                    [](int x, int) { return static_cast<std::size_t>(x); });
           }}};
}

/// The share e of all samples that makes this effect, e sqrt(k - 1), if it is moved into one of k
/// equally likely cells, or onto a diagonal.
double share_of(double effect, int cells) { return effect / std::sqrt(cells - 1.0); }

/// s of a sample is that of the one `lag` before it, for so many that the share of all pairs is
/// what is asked for: batches of 1024 begin without any before them.
Trial trial_of_lag(double effect, std::size_t lag) {
  const double pairs = (1024.0 - static_cast<double>(lag)) / 1024.0;
  const double share = share_of(effect, kPairedCells) / pairs;
  return changed_trial({.points = [share, lag](std::vector<SquarePoint>& points) {
    for (std::size_t i = points.size(); i-- > lag;) {
      if (is_chosen(points[i], share)) points[i].s = points[i - lag].s;
    }
  }});
}

/// A run of samples whose numbers are all small, in one coordinate.
Trial trial_of_runs(double effect, double SquarePoint::*coordinate) {
  const double share = share_of(effect, kRunCells);
  return changed_trial({.points = [share, coordinate](std::vector<SquarePoint>& points) {
    for (std::size_t i = 0; i + kRunLength <= points.size(); i += kRunLength) {
      if (!is_chosen(points[i], share)) continue;
      for (std::size_t k = i; k < i + kRunLength; ++k) points[k].*coordinate *= 0.1;
    }
  }});
}

/// A trial in which a share of the samples in some rows lies in the upper half of its cell. A test
/// pools cells that expect few samples: halves are larger than any pool, so that the effect
/// survives it.
Trial trial_of_positions(double effect, const std::function<bool(int y, int height)>& concerned) {
  const double share = share_of(effect, 2);
  const Trial correct = correct_trial();
  const auto positions =
      std::make_shared<const TexelPositions>(correct.drawn.extent(), kTrialTarget.density_space);
  return changed_trial(
      {.samples = [share, positions, concerned](std::span<const SquarePoint> points,
                                                std::span<TexelSample> samples) {
        for (std::size_t i = 0; i < samples.size(); ++i) {
          TexelSample& sample = samples[i];
          if (!concerned(sample.y, positions->extent().height)) continue;
          if (!is_chosen(points[i], share)) continue;
          const double across = digits_of(points[i]) / share;
          const double down = 0.5 * fraction_of(points[i].s * 0x1p24);
          sample.at = positions->sample({sample.x, sample.y, across, down, 1.0}).at;
        }
      }});
}

std::vector<Injection> injections_of_positions() {
  std::vector<Injection> injections = {
      {TestId::transformed_pair,
       [](double effect) {
         // The samples are moved into the quarters of the square on the diagonal, which no pool of
         // bins spans.
         const double share = share_of(effect, 2);
         return changed_trial({.points = [share](std::vector<SquarePoint>& points) {
           for (SquarePoint& u : points) {
             if (is_chosen(u, share)) u.s = 0.5 * (u.s + std::floor(2.0 * u.t));
           }
         }});
       }},
      {TestId::positions_first_row,
       [](double effect) { return trial_of_positions(effect, [](int y, int) { return y == 0; }); }},
      {TestId::positions_last_row,
       [](double effect) {
         return trial_of_positions(effect, [](int y, int height) { return y == height - 1; });
       }},
      {TestId::positions_between,
       [](double effect) {
         return trial_of_positions(effect,
                                   [](int y, int height) { return y > 0 && y < height - 1; });
       }},
      {TestId::run_sums_theta,
       [](double effect) { return trial_of_runs(effect, &SquarePoint::t); }},
      {TestId::run_sums_phi, [](double effect) { return trial_of_runs(effect, &SquarePoint::s); }}};
  constexpr auto kFirstLag = static_cast<std::size_t>(TestId::independence_lag_1);
  for (std::size_t i = 0; i < kLags.size(); ++i) {
    injections.push_back({static_cast<TestId>(kFirstLag + i),
                          [i](double effect) { return trial_of_lag(effect, kLags[i]); }});
  }
  return injections;
}

std::vector<Injection> injections_of_weights() {
  const auto scaled = [](double effect) { return trial_of_weights(1.0 + effect, 1.0 + effect); };
  // A variance more by w of weights that are (1 + d) and (1 - d) times the right ones.
  const auto noisy = [](std::size_t mean_case) {
    return [mean_case](double effect) {
      const Trial correct = correct_trial();
      const reference::EstimatorMoments& exact = correct.expectation->estimators[mean_case];
      const double d = std::sqrt(effect * exact.variance() / exact.raw[1]);
      return trial_of_weights(1.0 + d, 1.0 - d);
    };
  };
  return {{TestId::inverse_pdf, scaled},
          {TestId::irradiance_z_mean, scaled},
          {TestId::irradiance_z_uniform, scaled},
          {TestId::irradiance_z_variance, noisy(0)},
          {TestId::irradiance_x_mean, scaled},
          {TestId::irradiance_x_uniform, scaled},
          {TestId::irradiance_x_variance, noisy(1)}};
}

/// The test case of a trial for many runs, with a correct reference implementation.
TestCase test_case_of(const Trial& trial) {
  TestCase test_case = trial.test_case;
  const BoundSampler declared = correct_trial().test_case.instances[0].bind();
  test_case.reference_implementation = [declared] { return declared; };
  test_case.instances[0].claims_reference_texels = true;
  return made_once(test_case);
}

GateResult judge(const TestCase& test_case, bool sequential, std::uint64_t seed) {
  const GateOptions gate{.samples = kSamples, .seed = seed};
  return sequential ? run_sequential_gate({&test_case, 1}, gate) : run_gate({&test_case, 1}, gate);
}

TestRecord record_in(const GateResult& result, TestId test) {
  return *std::find_if(result.tests.begin(), result.tests.end(),
                       [&](const TestRecord& r) { return r.test == test; });
}

std::vector<Injection> all_injections() {
  std::vector<Injection> injections = injections_of_cells();
  for (const auto& more : {injections_of_positions(), injections_of_weights()}) {
    injections.insert(injections.end(), more.begin(), more.end());
  }
  return injections;
}

std::string key_of(const Injection& injection) {
  return "printed effects/" + full_name(injection.test);
}

/// The effects that the gate prints of a correct sampler.
std::vector<double> effects_of(std::span<const Injection> injections, std::uint64_t seed,
                               const Communicator& communicator) {
  const TestCase correct = test_case_of(correct_trial());
  std::vector<WorkCell<double>> cells;
  for (const Injection& injection : injections) {
    cells.push_back({key_of(injection), [&] {
                       const GateResult result = judge(correct, injection.sequential, seed);
                       return *record_in(result, injection.test).minimum_detectable_effect;
                     }});
  }
  const CellResults<double> results =
      gather(compute_cells<double>(cells, communicator.share), communicator);
  std::vector<double> effects;
  for (const Injection& injection : injections) effects.push_back(results.at(key_of(injection)));
  return effects;
}

}  // namespace

std::vector<TestId> printed_effects() {
  const TestCase correct = test_case_of(correct_trial());
  std::vector<TestId> tests;
  for (const bool sequential : {false, true}) {
    for (const TestRecord& record : judge(correct, sequential, 1).tests) {
      if (record.minimum_detectable_effect) tests.push_back(record.test);
    }
  }
  return tests;
}

std::vector<PowerRecord> measure_printed_effects(const PowerOptions& options,
                                                 const Progress& progress,
                                                 const Communicator& communicator) {
  const std::vector<Injection> injections = all_injections();
  const std::vector<double> effects = effects_of(injections, options.seed, communicator);
  std::vector<Replicates<Count>> replicates;
  for (std::size_t k = 0; k < injections.size(); ++k) {
    const Injection& injection = injections[k];
    replicates.push_back({key_of(injection), options.replicates, [&, k] {
                            const TestCase test_case = test_case_of(injection.make(effects[k]));
                            return [&, test_case](std::uint64_t i, Count& rejected) {
                              const GateResult result =
                                  judge(test_case, injection.sequential, options.seed + i);
                              const Outcome outcome = record_in(result, injection.test).outcome;
                              rejected.value += outcome == Outcome::reject ? 1 : 0;
                            };
                          }});
  }
  const std::vector<Count> rejected = compute_replicates<Count>(replicates, progress, communicator);
  std::vector<PowerRecord> records;
  for (std::size_t k = 0; k < injections.size(); ++k) {
    records.push_back({injections[k].test, effects[k], GateOptions{}.family_alpha, kSamples,
                       options.replicates, rejected[k].value, kDetectionPower, true});
  }
  return records;
}

}  // namespace lightproof
