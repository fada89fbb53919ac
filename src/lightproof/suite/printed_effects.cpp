// Every statistic that prints an effect has a defect of that size here.
#include <algorithm>
#include <cmath>
#include <functional>

#include "lightproof/samplers/texel_places.h"
#include "lightproof/suite/displaced_trial.h"
#include "lightproof/suite/gate.h"
#include "lightproof/suite/law_sampler.h"
#include "lightproof/suite/power.h"
#include "lightproof/suite/sequential_gate.h"

namespace lightproof {
namespace {

constexpr std::uint64_t kSamples = std::uint64_t{1} << 14U;

/// A defect as large as an effect of a test.
struct Plant {
  std::string test;
  std::function<Trial(double effect)> make;
  bool sequential = false;
};

/// What a sampler does to the points and the samples of a batch.
struct Changes {
  std::function<void(std::vector<SquarePoint>&)> points = {};
  std::function<void(std::span<const SquarePoint>, std::span<TexelSample>)> samples = {};
};

/// The sound trial, with what changes its points before, or its samples after, they are drawn.
Trial changed_trial(const Changes& changes) {
  Trial trial = sound_trial();
  const BoundSampler sound = trial.problem.candidates[0].bind();
  trial.problem.candidates[0].bind = [sound, changes] {
    return BoundSampler{
        [sound, changes](std::span<const SquarePoint> points, std::span<TexelSample> samples) {
          std::vector<SquarePoint> used(points.begin(), points.end());
          if (changes.points) changes.points(used);
          sound.sample(used, samples);
          if (changes.samples) changes.samples(points, samples);
        },
        sound.pdf};
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
  Grid<double> drawn = sound_trial().drawn;
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

std::vector<Plant> plants_of_cells() {
  const auto off_by = [](LawDistance distance) {
    return [distance](double effect) { return trial_off_by(effect, distance); };
  };
  const auto width = static_cast<std::size_t>(calibration_map().radiance.extent().width);
  return {{"reference/bins 16x32", off_by(distance_of_bins)},
          {"reference/texels", off_by(distance_of_texels)},
          {"reference/rows", off_by(distance_of_rows)},
          {"reference/columns", off_by(distance_of_columns)},
          {"reference/phi (Kuiper)", off_by(distance_of_phi)},
          {"reference/theta (Anderson-Darling)", off_by(distance_of_theta)},
          {"reference/sequential", off_by(distance_of_bins), true},
          {"reference/two samples with linear_scan", off_by(distance_of_bins)},
          {"self/bins 16x32 of its own pdf",
           [](double effect) {
             // The pdf is the declared law's, and so are the bins that it integrates to.
             Trial trial = trial_off_by(effect, distance_of_bins);
             const BoundSampler drawn = trial.problem.candidates[0].bind();
             const BoundSampler declared = sound_trial().problem.candidates[0].bind();
             trial.problem.candidates[0].bind = [drawn, declared] {
               return BoundSampler{drawn.sample, declared.pdf};
             };
             return trial;
           }},
          {"reference/worst texel",
           [width](double effect) {
             const Trial sound = sound_trial();
             return trial_of_excess(
                 effect, sound.expectation->masses.values(), [width](int x, int y) {
                   return static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
                 });
           }},
          {"reference/worst row",
           [](double effect) {
             const Trial sound = sound_trial();
             return trial_of_excess(effect, sound.expectation->rows,
                                    [](int, int y) { return static_cast<std::size_t>(y); });
           }},
          {"reference/worst column", [](double effect) {
             const Trial sound = sound_trial();
             return trial_of_excess(effect, sound.expectation->columns,
                                    [](int x, int) { return static_cast<std::size_t>(x); });
           }}};
}

/// Of k equally likely cells a share e of all samples moved into one, or onto a diagonal, makes an
/// effect of e sqrt(k - 1).
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
  const Trial sound = sound_trial();
  const auto places =
      std::make_shared<const TexelPlaces>(sound.drawn.extent(), kTrialTarget.weighting);
  return changed_trial({.samples = [share, places, concerned](std::span<const SquarePoint> points,
                                                              std::span<TexelSample> samples) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      TexelSample& sample = samples[i];
      if (!concerned(sample.y, places->extent().height)) continue;
      if (!is_chosen(points[i], share)) continue;
      const double across = digits_of(points[i]) / share;
      const double down = 0.5 * fraction_of(points[i].s * 0x1p24);
      sample.at = places->sample(sample.x, sample.y, across, down, 1.0).at;
    }
  }});
}

std::vector<Plant> plants_of_places() {
  std::vector<Plant> plants = {
      {"reference/transformed pair",
       [](double effect) {
         // In the quarters of the square on the diagonal, which no pool of bins spans.
         const double share = share_of(effect, 2);
         return changed_trial({.points = [share](std::vector<SquarePoint>& points) {
           for (SquarePoint& u : points) {
             if (is_chosen(u, share)) u.s = 0.5 * (u.s + std::floor(2.0 * u.t));
           }
         }});
       }},
      {"reference/positions in the first row",
       [](double effect) { return trial_of_positions(effect, [](int y, int) { return y == 0; }); }},
      {"reference/positions in the last row",
       [](double effect) {
         return trial_of_positions(effect, [](int y, int height) { return y == height - 1; });
       }},
      {"reference/positions between the pole rows",
       [](double effect) {
         return trial_of_positions(effect,
                                   [](int y, int height) { return y > 0 && y < height - 1; });
       }},
      {"reference/sums over runs of 16, theta",
       [](double effect) { return trial_of_runs(effect, &SquarePoint::t); }},
      {"reference/sums over runs of 16, phi",
       [](double effect) { return trial_of_runs(effect, &SquarePoint::s); }}};
  for (const std::size_t lag : kLags) {
    plants.push_back({"reference/independence at lag " + std::to_string(lag),
                      [lag](double effect) { return trial_of_lag(effect, lag); }});
  }
  return plants;
}

std::vector<Plant> plants_of_weights() {
  const auto scaled = [](double effect) { return trial_of_weights(1.0 + effect, 1.0 + effect); };
  // A variance more by w of weights that are (1 + d) and (1 - d) times the right ones.
  const auto noisy = [](std::size_t mean_case) {
    return [mean_case](double effect) {
      const Trial sound = sound_trial();
      const reference::EstimatorMoments& exact = sound.expectation->estimators[mean_case];
      const double d = std::sqrt(effect * exact.variance() / exact.raw[1]);
      return trial_of_weights(1.0 + d, 1.0 - d);
    };
  };
  std::vector<Plant> plants = {{"self/mean of 1/pdf", scaled}};
  for (std::size_t i = 0; i < kMeanCaseCount; ++i) {
    const std::string name(kMeanCases[i].name);
    plants.push_back({"mean/" + name, scaled});
    plants.push_back({"mean/" + name + ", against uniform", scaled});
    plants.push_back({"variance/" + name, noisy(i)});
  }
  return plants;
}

/// The problem of a trial for many runs, with a sound twin.
Problem problem_of(const Trial& trial) {
  Problem problem = trial.problem;
  const BoundSampler declared = sound_trial().problem.candidates[0].bind();
  problem.twin = [declared] { return declared; };
  problem.candidates[0].has_twin = true;
  return made_once(problem);
}

GateResult judge(const Problem& problem, bool sequential, std::uint64_t seed) {
  const GateOptions gate{.samples = kSamples, .seed = seed};
  return sequential ? run_sequential_gate({&problem, 1}, gate) : run_gate({&problem, 1}, gate);
}

TestRecord record_in(const GateResult& result, std::string_view test) {
  return *std::find_if(result.tests.begin(), result.tests.end(),
                       [&](const TestRecord& r) { return name_of(r) == test; });
}

}  // namespace

std::vector<std::string> printed_effects() {
  const Problem sound = problem_of(sound_trial());
  std::vector<std::string> names;
  for (const bool sequential : {false, true}) {
    for (const TestRecord& record : judge(sound, sequential, 1).tests) {
      if (record.detectable_effect) names.push_back(name_of(record));
    }
  }
  return names;
}

std::vector<PowerRecord> measure_printed_effects(const PowerOptions& options,
                                                 const Progress& progress) {
  std::vector<Plant> plants = plants_of_cells();
  for (const auto& more : {plants_of_places(), plants_of_weights()}) {
    plants.insert(plants.end(), more.begin(), more.end());
  }
  const Problem sound = problem_of(sound_trial());
  std::vector<PowerRecord> records;
  for (std::size_t k = 0; k < plants.size(); ++k) {
    const Plant& plant = plants[k];
    const double effect =
        *record_in(judge(sound, plant.sequential, options.seed), plant.test).detectable_effect;
    const Problem problem = problem_of(plant.make(effect));
    std::vector<char> rejected(options.replicates);
    const auto parts = static_cast<double>(plants.size());
    for_each_replicate(
        options.replicates,
        part_of(progress, static_cast<double>(k) / parts, static_cast<double>(k + 1) / parts),
        [&](std::size_t i) {
          const GateResult result = judge(problem, plant.sequential, options.seed + i);
          rejected[i] = record_in(result, plant.test).outcome == Outcome::reject ? 1 : 0;
        });
    records.push_back({plant.test, effect, GateOptions{}.family_alpha, kSamples, options.replicates,
                       static_cast<std::uint64_t>(std::count(rejected.begin(), rejected.end(), 1)),
                       kDetectablePower, true});
  }
  return records;
}

}  // namespace lightproof
