#include "lightproof/accuracy/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "lightproof/accuracy/timing.h"
#include "lightproof/core/error.h"
#include "lightproof/core/moments.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/stats/power_law.h"

namespace lightproof {
namespace {

constexpr std::array kQualities = {
    AccuracyQuality{"draft", 4096, 3, kReceiverPoints},
    AccuracyQuality{"default", 65536, 4, kReceiverPoints},
    AccuracyQuality{"paper", 65536, 32, 192},
};

/// The largest map of which a product is tabulated at every point: two seconds or so for all.
constexpr std::size_t kMostTabulatedTexels = std::size_t{1} << 21U;

/// Texels of all maps that may be prepared at a time, an estimator each.
constexpr std::size_t kPreparedTexels = std::size_t{1} << 26U;

/// An error whose own standard error is larger than this share of it is not fitted.
constexpr double kMeasurableError = 0.25;

/// The steps between numbers of samples; a table for each point allows few of them.
constexpr std::uint64_t kStep = 4;
constexpr std::uint64_t kTabulatedStep = 16;

/// What one round found of one number of samples.
struct RoundOfLevel {
  std::vector<Moments> errors;  ///< of luminance, over the mean of the reference, a pixel each
  std::vector<Moments> squared_errors;  ///< a pixel each
  double seconds = 0.0;                 ///< of an estimate

  static auto fields(auto& level) {
    return std::tie(level.errors, level.squared_errors, level.seconds);
  }
};

/// One round of an estimator: a level for each number of samples.
using Round = std::vector<RoundOfLevel>;

/// The numbers of samples at which an estimator is measured.
std::vector<std::uint64_t> levels_of(const EstimatorInfo& info, const AccuracyOptions& options) {
  if (options.samples) return options.samples(info);
  if (info.ignores_budget) return {1};
  const std::uint64_t step = info.tabulates_each_point ? kTabulatedStep : kStep;
  std::vector<std::uint64_t> levels;
  for (std::uint64_t n = 1; n * info.candidates <= options.quality.most_samples; n *= step) {
    if (n >= info.samples_per_estimate) levels.push_back(n);
  }
  return levels;
}

/// Estimates at each point that one round makes of a number of samples.
std::uint64_t estimates_of_a_round(const EstimatorInfo& info, const AccuracyOptions& options,
                                   std::uint64_t samples) {
  if (info.tabulates_each_point) return 1;
  return std::clamp<std::uint64_t>(options.samples_of_a_round / (samples * info.candidates), 1,
                                   options.most_estimates_of_a_round);
}

/// An estimator, ready for a scene, and how long it took to get there.
struct Contender {
  const EstimatorInfo* info;
  BoundEstimator estimator;
  double set_up_seconds;  ///< elapsed
  double set_up_processor_seconds;
  std::size_t bytes;
};

/// Where an estimator is measured.
struct Course {
  const LitReceiver* lit;
  const Contender* contender;
  const AccuracyOptions* options;

  std::string key(int round) const {
    return fmt::format("accuracy{}{}/{}/{}/{}/{}/{:04}", options->purpose.empty() ? "" : " for ",
                       options->purpose, lit->map().name, lit->receiver().name,
                       lit->material().name, contender->info->name, round);
  }
};

RoundOfLevel measure_level(const Course& course, const RandomStream& stream, std::uint64_t samples,
                           std::uint64_t first) {
  const LitReceiver& lit = *course.lit;
  const std::size_t pixels = lit.pixels().size();
  const std::uint64_t estimates =
      estimates_of_a_round(*course.contender->info, *course.options, samples);
  std::vector<Rgb> found(pixels * estimates);
  const double begin = thread_seconds();
  for (std::uint64_t i = 0; i < estimates; ++i) {
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
      found[i * pixels + pixel] = course.contender->estimator.integrate(
          lit.pixels()[pixel].point, stream.substream(pixel), {first + i * samples, samples}, {});
    }
  }
  const double seconds = thread_seconds() - begin;
  RoundOfLevel level{std::vector<Moments>(pixels), std::vector<Moments>(pixels),
                     seconds / static_cast<double>(found.size())};
  for (std::uint64_t i = 0; i < estimates; ++i) {
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
      const double luminance = luminance_of(found[i * pixels + pixel], lit.map().weights);
      const double error = (luminance - lit.exact(pixel)) / lit.mean();
      level.errors[pixel].add(error);
      level.squared_errors[pixel].add(error * error);
    }
  }
  return level;
}

Round measure_round(const Course& course, int round) {
  const RandomStream stream(course.key(round), course.options->seed);
  const EstimatorInfo& info = *course.contender->info;
  Round levels;
  std::uint64_t first = 0;
  for (const std::uint64_t samples : levels_of(info, *course.options)) {
    levels.push_back(measure_level(course, stream, samples, first));
    first += samples * estimates_of_a_round(info, *course.options, samples);
  }
  return levels;
}

/// Adds the errors of a later round; the time is the least.
void merge(RoundOfLevel& level, const RoundOfLevel& more) {
  for (std::size_t pixel = 0; pixel < level.errors.size(); ++pixel) {
    level.errors[pixel].merge(more.errors[pixel]);
    level.squared_errors[pixel].merge(more.squared_errors[pixel]);
  }
  level.seconds = std::min(level.seconds, more.seconds);
}

/// The standard error, over the value, of a mean square error that was measured by so many
/// estimates of `samples` samples each: from the exact fourth moment, which knows of rare and large
/// estimates that were not seen.
double relative_error_of_mse(const Spread& spread, std::uint64_t samples_per_estimate,
                             std::uint64_t samples, double estimates) {
  const double n =
      std::max(1.0, static_cast<double>(samples) / static_cast<double>(samples_per_estimate));
  const double v = spread.variance / static_cast<double>(samples_per_estimate);
  const double fourth = (spread.fourth_central + 3.0 * (n - 1.0) * v * v) / (n * n * n);
  const double mse = v / n;
  return mse > 0.0 ? std::sqrt(std::max(0.0, fourth - mse * mse) / estimates) / mse : 0.0;
}

/// `spread`: of the estimator's single estimates, or of those of the same at independent points.
AccuracyPoint point_of(const EstimatorInfo& info, const RoundOfLevel& level, std::uint64_t samples,
                       const std::optional<Spread>& spread) {
  const auto pixels = static_cast<double>(level.errors.size());
  double mse = 0.0;
  double variance = 0.0;
  double estimates = 0.0;
  for (const Moments& squared : level.squared_errors) {
    mse += squared.mean() / pixels;
    variance += squared.variance() / static_cast<double>(squared.count()) / (pixels * pixels);
    estimates += static_cast<double>(squared.count());
  }
  AccuracyPoint point{samples, level.seconds, std::sqrt(mse), 0.0};
  if (!(mse > 0.0)) return point;
  double relative = std::sqrt(variance) / mse;
  if (spread) {
    relative = std::max(
        relative, relative_error_of_mse(*spread, info.samples_per_estimate, samples, estimates));
  }
  point.rmse_error = 0.5 * relative * point.rmse;
  return point;
}

/// The root mean square over the pixels of the mean error, less what its own scatter adds.
double bias_of(const RoundOfLevel& level) {
  double squared = 0.0;
  for (const Moments& errors : level.errors) {
    squared +=
        errors.mean() * errors.mean() - errors.variance() / static_cast<double>(errors.count());
  }
  return std::sqrt(std::max(0.0, squared / static_cast<double>(level.errors.size())));
}

void fit_slope(AccuracyLine& line) {
  std::vector<PowerLawPoint> measured;
  for (const AccuracyPoint& point : line.points) {
    const double error = point.rmse_error / point.rmse;
    if (!(error > 0.0 && error <= kMeasurableError) || point.rmse * point.rmse < kNoVariance)
      continue;
    measured.push_back({static_cast<double>(point.samples), point.rmse, error});
  }
  if (measured.size() < 3) return;
  const PowerLaw fit = fit_power_law(measured);
  line.slope = fit.exponent;
  line.slope_error = exponent_error_with_scatter(fit, measured);
}

AccuracyLine line_of(const Course& course, const Round& levels) {
  const EstimatorInfo& info = *course.contender->info;
  AccuracyLine line;
  line.estimator = info.name;
  line.family = info.family;
  line.is_biased = info.is_biased || (info.ignores_occlusion && course.lit->receiver().occluded);
  line.set_up_seconds = course.contender->set_up_seconds;
  line.set_up_processor_seconds = course.contender->set_up_processor_seconds;
  line.bytes = course.contender->bytes;
  const std::optional<Spread> own = course.lit->spread(info);
  const EstimatorInfo& independent =
      info.at_independent_points.empty() ? info : estimator_by_name(info.at_independent_points);
  const std::optional<Spread> spread = course.lit->spread(independent);
  const std::vector<std::uint64_t> samples = levels_of(info, *course.options);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    AccuracyPoint point = point_of(independent, levels[i], samples[i], spread);
    if (own) point.predicted = std::sqrt(own->variance / static_cast<double>(samples[i]));
    line.points.push_back(point);
  }
  if (line.is_biased && !info.bias_vanishes) line.floor = bias_of(levels.back());
  if (!info.ignores_budget) fit_slope(line);
  return line;
}

/// An estimator that is prepared for the map.
struct Prepared {
  const EstimatorInfo* info;
  Timed<PreparedEstimator> estimator;
};

std::vector<Prepared> prepare_all(const EnvironmentMap& map,
                                  std::span<const EstimatorInfo* const> chosen) {
  std::vector<Prepared> all;
  for (const EstimatorInfo* info : chosen) {
    all.push_back({info, timed([&] { return info->prepare(map); })});
  }
  return all;
}

/// The contenders of one scene.
std::vector<Contender> bind_all(const LitReceiver& lit, std::span<const Prepared> prepared) {
  std::vector<Contender> bound;
  const Extent extent = lit.map().radiance.extent();
  for (const Prepared& one : prepared) {
    const Material& material = lit.material().material;
    if (!one.info->serves(material) || !reason_to_leave_out(*one.info, extent).empty()) continue;
    const PreparedEstimator& of_map = one.estimator.made;
    auto of_material = timed([&] { return of_map.bind(lit.scene(), material); });
    const std::size_t bytes = of_map.bytes + of_material.made.bytes;
    bound.push_back({one.info, std::move(of_material.made),
                     one.estimator.elapsed_seconds + of_material.elapsed_seconds,
                     one.estimator.processor_seconds + of_material.processor_seconds, bytes});
  }
  return bound;
}

/// What the filter asks for, and what draws the same at independent points.
EstimatorFilter with_independent(const EstimatorFilter& filter) {
  if (!filter) return filter;
  return [&filter](const EstimatorInfo& info) {
    return filter(info) || std::ranges::any_of(estimators(), [&](const EstimatorInfo& row) {
             return row.at_independent_points == info.name && filter(row);
           });
  };
}

/// All scenes of a map.
class Charts {
 public:
  Charts(const EnvironmentMap& map, std::span<const LitReceiver* const> lit,
         const AccuracyOptions& options)
      : map_(&map), options_(&options), lit_(lit.begin(), lit.end()) {
    for (const LitReceiver* receiver : lit_) charts_.push_back(empty_chart(*receiver));
  }

  /// The estimators that some scene shows. What a scene does not show is put down there.
  std::vector<const EstimatorInfo*> choose() {
    std::vector<const EstimatorInfo*> chosen;
    for (const EstimatorInfo& info : estimators()) {
      if (options_->select && !options_->select(info)) continue;
      std::size_t shown = 0;
      for (std::size_t i = 0; i < lit_.size(); ++i) {
        std::string reason = info.serves(lit_[i]->material().material)
                                 ? reason_to_leave_out(info, map_->radiance.extent())
                                 : "it does not serve this material";
        if (reason.empty()) {
          ++shown;
        } else {
          charts_[i].left_out.push_back({std::string(info.name), std::move(reason)});
        }
      }
      if (shown > 0) chosen.push_back(&info);
    }
    return chosen;
  }

  /// Measures some of the estimators, all of them in every round.
  void measure(std::span<const EstimatorInfo* const> chosen, const Progress& progress,
               const Communicator& communicator) {
    const std::vector<Prepared> prepared = prepare_all(*map_, chosen);
    std::vector<std::vector<Contender>> contenders;
    std::vector<Course> courses;
    for (const LitReceiver* lit : lit_) contenders.push_back(bind_all(*lit, prepared));
    for (std::size_t i = 0; i < lit_.size(); ++i) {
      for (const Contender& contender : contenders[i]) {
        courses.push_back({lit_[i], &contender, options_});
      }
    }
    std::vector<WorkCell<Round>> cells;
    for (int round = 0; round < options_->quality.rounds; ++round) {
      for (const Course& course : courses) {
        cells.push_back(
            {course.key(round), [&course, round] { return measure_round(course, round); }});
      }
    }
    const CellResults<Round> rounds = gather(
        compute_cells<Round>(cells, communicator.share, progress, "estimators", communicator.kept),
        communicator);
    std::size_t course = 0;
    for (std::size_t i = 0; i < lit_.size(); ++i) {
      for (std::size_t k = 0; k < contenders[i].size(); ++k, ++course) {
        charts_[i].lines.push_back(line_of(courses[course], merged(courses[course], rounds)));
      }
    }
  }

  std::vector<AccuracyChart> take() { return std::move(charts_); }

 private:
  AccuracyChart empty_chart(const LitReceiver& lit) const {
    AccuracyChart chart;
    chart.map = map_->name;
    chart.receiver = lit.receiver().name;
    chart.material = lit.material().name;
    chart.is_occluded = lit.receiver().occluded;
    chart.shading_points = static_cast<int>(lit.pixels().size());
    chart.replicates = options_->quality.rounds;
    chart.quality = options_->quality.name;
    chart.mean = lit.mean();
    return chart;
  }

  Round merged(const Course& course, const CellResults<Round>& rounds) const {
    Round levels = rounds.at(course.key(0));
    for (int round = 1; round < options_->quality.rounds; ++round) {
      const Round& more = rounds.at(course.key(round));
      for (std::size_t level = 0; level < levels.size(); ++level) merge(levels[level], more[level]);
    }
    return levels;
  }

  const EnvironmentMap* map_;
  const AccuracyOptions* options_;
  std::vector<const LitReceiver*> lit_;
  std::vector<AccuracyChart> charts_;
};

std::vector<AccuracyChart> measure_all(const EnvironmentMap& map,
                                       std::span<const LitReceiver* const> lit,
                                       const AccuracyOptions& options, const Progress& progress,
                                       const Communicator& communicator) {
  Charts charts(map, lit, options);
  const std::vector<const EstimatorInfo*> chosen = charts.choose();
  const std::size_t together = std::max<std::size_t>(
      1, kPreparedTexels / std::max<std::size_t>(1, map.radiance.extent().count()));
  for (std::size_t first = 0; first < chosen.size(); first += together) {
    const std::size_t count = std::min(together, chosen.size() - first);
    const auto share = [&](std::size_t done) {
      return static_cast<double>(done) / static_cast<double>(chosen.size());
    };
    charts.measure(std::span(chosen).subspan(first, count),
                   part_of(progress, share(first), share(first + count)), communicator);
  }
  return charts.take();
}

}  // namespace

std::span<const AccuracyQuality> accuracy_qualities() { return kQualities; }

std::string reason_to_leave_out(const EstimatorInfo& info, Extent map) {
  if (info.tabulates_each_point && map.count() > kMostTabulatedTexels) {
    return fmt::format("a table of {} x {} texels at every shading point takes too long", map.width,
                       map.height);
  }
  return {};
}

const AccuracyQuality& accuracy_quality_by_name(std::string_view name) {
  std::string known;
  for (const AccuracyQuality& quality : kQualities) {
    if (quality.name == name) return quality;
    known.append(known.empty() ? "" : ", ").append(quality.name);
  }
  throw InputError(fmt::format("there is no quality '{}'; there are {}", name, known));
}

std::vector<AccuracyChart> measure_accuracy(const EnvironmentMap& map,
                                            std::span<const AccuracyScene> scenes,
                                            const AccuracyOptions& options,
                                            const Progress& progress,
                                            const Communicator& communicator) {
  std::vector<std::unique_ptr<LitReceiver>> lit;
  std::vector<const LitReceiver*> all;
  for (const AccuracyScene& scene : scenes) {
    if (progress)
      progress("exact light",
               0.2 * static_cast<double>(lit.size()) / static_cast<double>(scenes.size()));
    lit.push_back(std::make_unique<LitReceiver>(map, *scene.receiver, scene.material,
                                                options.quality.shading_points,
                                                with_independent(options.select)));
    all.push_back(lit.back().get());
  }
  return measure_all(map, all, options, part_of(progress, 0.2, 1.0), communicator);
}

AccuracyChart measure_accuracy(const LitReceiver& lit, const AccuracyOptions& options,
                               const Progress& progress, const Communicator& communicator) {
  const LitReceiver* one = &lit;
  return measure_all(lit.map(), {&one, 1}, options, progress, communicator).front();
}

}  // namespace lightproof
