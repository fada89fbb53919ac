#include "lightproof/study/convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "lightproof/accuracy/exact_light.h"
#include "lightproof/core/executor.h"
#include "lightproof/core/moments.h"
#include "lightproof/core/parallel.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/render/receiver.h"
#include "lightproof/stats/power_law.h"

namespace lightproof {
namespace {

/// An error whose own standard error is larger than this share of it is not measured: where light
/// is found by rare hits, most estimates miss it and look better than they are.
constexpr double kMeasurableError = 0.25;

/// What was measured at one pixel: squared errors summed over replicates, for every N, and the
/// moments of single estimates.
struct PixelErrors {
  std::vector<double> squared;
  Moments single;

  static auto fields(auto& errors) { return std::tie(errors.squared, errors.single); }
};

/// The pixels of one line of the study.
using LineErrors = std::vector<PixelErrors>;

std::vector<std::uint64_t> sample_counts(std::uint64_t most) {
  std::vector<std::uint64_t> counts;
  for (std::uint64_t n = 1; n <= most; n *= 4) counts.push_back(n);
  return counts;
}

/// Draws estimates at one pixel, one after the other; every number of samples has its own, so that
/// the points of a convergence line are independent.
class PixelEstimator {
 public:
  PixelEstimator(const BoundEstimator& estimator, const ShadingPoint& point,
                 const RandomStream& stream, LuminanceWeights weights)
      : estimator_(&estimator), point_(&point), stream_(stream), weights_(weights) {}

  /// The luminance of an estimate that uses the next `count` samples.
  double mean(std::uint64_t count) {
    double sum = 0.0;
    bool is_mean = false;
    const Rgb estimate =
        estimator_->integrate(*point_, stream_, {next_, count}, [&](std::span<const Rgb> singles) {
          is_mean = true;
          for (const Rgb single : singles) {
            const double luminance = luminance_of(single, weights_);
            sum += luminance;
            single_.add(luminance);
          }
        });
    next_ += count;
    return is_mean ? sum / static_cast<double>(count) : luminance_of(estimate, weights_);
  }

  /// The moments of all single estimates so far.
  const Moments& single() const { return single_; }

 private:
  const BoundEstimator* estimator_;
  const ShadingPoint* point_;
  RandomStream stream_;
  LuminanceWeights weights_;
  std::uint64_t next_ = 0;
  Moments single_;
};

PixelErrors measure_pixel(PixelEstimator& estimator, double exact,
                          std::span<const std::uint64_t> counts, int replicates) {
  PixelErrors errors{std::vector<double>(counts.size()), {}};
  for (int replicate = 0; replicate < replicates; ++replicate) {
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const double error = estimator.mean(counts[i]) - exact;
      errors.squared[i] += error * error;
    }
  }
  errors.single = estimator.single();
  return errors;
}

/// Variance of the squared error of the mean of n estimates: its fourth moment less the square of
/// its second.
double squared_error_variance(const reference::EstimatorMoments& exact, double n) {
  const double v = exact.variance();
  const double fourth = (exact.fourth_central() + 3.0 * (n - 1.0) * v * v) / (n * n * n);
  return fourth - v * v / (n * n);
}

/// One line of the study, with the pixels of its receiver.
struct Line {
  const EnvironmentMap* map;
  const ReceiverInfo* receiver;
  const MaterialInfo* material;
  const EstimatorInfo* info;
  BoundEstimator estimator;
  std::span<const Pixel> pixels;
  std::vector<reference::EstimatorMoments> exact;
  int replicates;

  /// The key of its cell of work, and of its random numbers.
  std::string key() const {
    return fmt::format("convergence/{}/{}/{}/{}", map->name, receiver->name, material->name,
                       info->name);
  }
};

/// Averages over the pixels of what is exact.
struct ExactAverages {
  double mean = 0.0;
  double variance = 0.0;
};

ExactAverages averages_of(const Line& line) {
  ExactAverages averages;
  const double pixels = static_cast<double>(line.exact.size());
  for (const auto& exact : line.exact) {
    averages.mean += exact.mean() / pixels;
    averages.variance += exact.variance() / pixels;
  }
  return averages;
}

std::vector<ConvergencePoint> convergence_points(const Line& line,
                                                 std::span<const PixelErrors> errors,
                                                 std::span<const std::uint64_t> counts) {
  const ExactAverages averages = averages_of(line);
  const double estimates =
      static_cast<double>(line.replicates) * static_cast<double>(errors.size());
  std::vector<ConvergencePoint> points;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double n = static_cast<double>(counts[i]);
    double squared = 0.0;
    double variance = 0.0;
    for (std::size_t pixel = 0; pixel < errors.size(); ++pixel) {
      squared += errors[pixel].squared[i] / estimates;
      variance += line.replicates * squared_error_variance(line.exact[pixel], n);
    }
    const double predicted = std::sqrt(averages.variance / n);
    const double mse_error = std::sqrt(std::max(0.0, variance)) / estimates;
    points.push_back({counts[i], std::sqrt(squared) / averages.mean,
                      predicted > 0.0 ? 0.5 * mse_error / predicted / averages.mean : 0.0,
                      predicted / averages.mean});
  }
  return points;
}

void measure_variance(const Line& line, std::span<const PixelErrors> errors,
                      ConvergenceRecord& record) {
  const ExactAverages averages = averages_of(line);
  const double pixels = static_cast<double>(errors.size());
  double measured = 0.0;
  double error_squared = 0.0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const auto& exact = line.exact[i];
    measured += errors[i].single.variance() / pixels;
    error_squared += (exact.fourth_central() - exact.variance() * exact.variance()) /
                     static_cast<double>(errors[i].single.count());
  }
  const double scale = averages.mean * averages.mean;
  record.measured_variance = measured / scale;
  record.predicted_variance = averages.variance / scale;
  record.variance_ratio_error =
      std::sqrt(std::max(0.0, error_squared)) / pixels / averages.variance;
}

ConvergenceRecord record_of(const Line& line, std::span<const PixelErrors> errors,
                            std::span<const std::uint64_t> counts) {
  ConvergenceRecord record;
  record.map = line.map->name;
  record.receiver = line.receiver->name;
  record.material = line.material->name;
  record.estimator = line.info->name;
  record.pixels = static_cast<int>(errors.size());
  record.replicates = line.replicates;
  record.points = convergence_points(line, errors, counts);
  measure_variance(line, errors, record);
  if (record.predicted_variance < kNoVariance) {
    record.slope = record.slope_error = record.variance_ratio_error =
        std::numeric_limits<double>::quiet_NaN();
    return record;
  }
  std::vector<PowerLawPoint> measured;
  for (const ConvergencePoint& point : record.points) {
    const double error = point.rmse_error / point.predicted;
    if (!(error > 0.0 && error <= kMeasurableError)) continue;
    measured.push_back({static_cast<double>(point.samples), point.rmse, error});
  }
  if (measured.size() < 3) {
    record.slope = record.slope_error = std::numeric_limits<double>::quiet_NaN();
    return record;
  }
  const PowerLaw fit = fit_power_law(measured);
  record.slope = fit.exponent;
  record.slope_error = fit.exponent_error;
  return record;
}

/// A receiver's scene and pixels.
struct Stage {
  explicit Stage(const ReceiverInfo& info, Extent picture)
      : receiver(&info), scene(info.content), pixels(visible_pixels(info, scene, picture)) {}
  const ReceiverInfo* receiver;
  Scene scene;
  std::vector<Pixel> pixels;
};

/// Whether the estimator's convergence is measured, beside its exact moments.
bool is_measured(const EstimatorInfo& info) { return info.is_studied && info.density; }

/// The estimators in the registry's order, prepared for one map; empty where the error is not
/// predicted.
using PreparedEstimators = std::vector<PreparedEstimator>;

PreparedEstimators prepared_for(const EnvironmentMap& map) {
  PreparedEstimators prepared;
  for (const EstimatorInfo& info : estimators()) {
    prepared.push_back(is_measured(info) ? info.prepare(map) : PreparedEstimator{});
  }
  return prepared;
}

/// What light is gathered from: the maps, their luminances, and what the estimators keep of them.
struct Lights {
  std::span<const EnvironmentMap> maps;
  std::vector<Grid<double>> luminances;
  std::vector<PreparedEstimators> prepared;

  explicit Lights(std::span<const EnvironmentMap> all) : maps(all) {
    for (const EnvironmentMap& map : maps) {
      luminances.push_back(luminance_of(map));
      prepared.push_back(prepared_for(map));
    }
  }
};

std::vector<Line> lines_of(const Lights& lights, const Stage& stage, const MaterialInfo& material,
                           int estimates) {
  const auto exact =
      exact_light(lights.luminances, *stage.receiver, stage.scene, material.material, stage.pixels);
  const int pixels = static_cast<int>(stage.pixels.size());
  std::vector<Line> lines;
  for (std::size_t map = 0; map < lights.maps.size(); ++map) {
    for (std::size_t i = 0; i < estimators().size(); ++i) {
      const EstimatorInfo& info = estimators()[i];
      if (!is_measured(info)) continue;
      Line line{&lights.maps[map],
                stage.receiver,
                &material,
                &info,
                lights.prepared[map][i].bind(stage.scene, material.material),
                stage.pixels,
                {},
                (estimates + pixels - 1) / pixels};
      for (const auto& moments : exact[map]) line.exact.push_back(moments[*info.density]);
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

LineErrors measure_line(const Line& line, std::span<const std::uint64_t> counts,
                        std::uint64_t seed) {
  const RandomStream stream(line.key(), seed);
  LineErrors errors(line.pixels.size());
  parallel_for(errors.size(), [&](std::size_t pixel) {
    PixelEstimator estimator(line.estimator, line.pixels[pixel].point, stream.substream(pixel),
                             line.map->weights);
    errors[pixel] = measure_pixel(estimator, line.exact[pixel].mean(), counts, line.replicates);
  });
  return errors;
}

/// A cell of work for every line; then each line summed up.
std::vector<ConvergenceRecord> measure_lines(std::span<const Line> lines,
                                             const ConvergenceOptions& options,
                                             const Progress& progress,
                                             const Communicator& communicator) {
  const std::vector<std::uint64_t> counts = sample_counts(options.most_samples);
  std::vector<WorkCell<LineErrors>> cells;
  for (const Line& line : lines) {
    cells.push_back({line.key(), [&] { return measure_line(line, counts, options.seed); }});
  }
  const CellResults<LineErrors> results =
      gather(compute_cells<LineErrors>(cells, communicator.share, progress, "convergence",
                                       communicator.kept),
             communicator);
  std::vector<ConvergenceRecord> records;
  for (const Line& line : lines) {
    records.push_back(record_of(line, results.at(line.key()), counts));
  }
  return records;
}

}  // namespace

std::vector<ConvergenceRecord> study_convergence(std::span<const EnvironmentMap> maps,
                                                 const ConvergenceOptions& options,
                                                 const Progress& progress,
                                                 const Communicator& communicator) {
  const Lights lights(maps);
  std::vector<std::unique_ptr<Stage>> stages;
  for (const ReceiverInfo& receiver : receivers()) {
    stages.push_back(std::make_unique<Stage>(receiver, options.picture));
  }
  const Progress exact = part_of(progress, 0.0, 0.3);
  const auto studied =
      static_cast<std::size_t>(std::ranges::count(materials(), true, &MaterialInfo::is_studied));
  const double pairs = static_cast<double>(stages.size() * studied);
  double done = 0.0;
  std::vector<Line> lines;
  for (const auto& stage : stages) {
    for (const MaterialInfo& material : materials()) {
      if (!material.is_studied) continue;
      if (exact) exact("exact light", done++ / pairs);
      auto more = lines_of(lights, *stage, material, options.estimates);
      std::move(more.begin(), more.end(), std::back_inserter(lines));
    }
  }
  return measure_lines(lines, options, part_of(progress, 0.3, 1.0), communicator);
}

}  // namespace lightproof
