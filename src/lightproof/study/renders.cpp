#include "lightproof/study/renders.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <memory>

#include "lightproof/accuracy/timing.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/materials/material.h"
#include "lightproof/render/picture.h"

namespace lightproof {
namespace {

/// What is pictured: something glossy that is partly in the shade, and something diffuse.
struct PicturedScene {
  std::string_view receiver;
  std::string_view material;
};
constexpr std::array kScenes = {PicturedScene{"sphere-on-plane", "ggx:0.3"},
                                PicturedScene{"sphere", "lambert"}};

/// The representative ones in the order of the registry; then, if asked for, all others.
std::vector<const EstimatorInfo*> pictured(const RenderOptions& options) {
  std::vector<const EstimatorInfo*> chosen;
  for (const EstimatorInfo& info : estimators()) {
    if (info.is_representative || options.every_estimator) chosen.push_back(&info);
  }
  std::ranges::stable_partition(chosen, &EstimatorInfo::is_representative);
  return chosen;
}

/// The estimator with which references are rendered.
constexpr std::string_view kReferenceEstimator = "mis one-sample sobol";

/// Points on which the time of an estimate is measured, and the most samples that are tried.
constexpr std::size_t kTimedPoints = 48;
constexpr std::uint64_t kMostSamples = 65536;

/// Signed errors of the luminances at the receiver's pixels over the mean of the reference there;
/// and their root mean square. Pixels beside the receiver show the map and have no error.
void compare(RenderRecord& record, std::span<const Pixel> pixels, LuminanceWeights weights) {
  const auto luminance = [&](const Grid<Rgb>& picture, const Pixel& pixel) {
    return luminance_of(picture(pixel.x, pixel.y), weights);
  };
  const double count = static_cast<double>(pixels.size());
  double mean = 0.0;
  for (const Pixel& pixel : pixels) mean += luminance(record.reference, pixel) / count;
  record.error = Grid<double>(record.picture.extent());
  double squared = 0.0;
  for (const Pixel& pixel : pixels) {
    const double error =
        (luminance(record.picture, pixel) - luminance(record.reference, pixel)) / mean;
    record.error(pixel.x, pixel.y) = error;
    squared += error * error;
  }
  record.rmse = std::sqrt(squared / count);
}

/// An estimator that is ready for a scene.
struct Painter {
  const EstimatorInfo* info;
  BoundEstimator estimator;

  /// The time of one estimate, averaged over points all over the receiver; the least of three.
  double point_seconds(std::span<const Pixel> pixels, std::uint64_t samples) const {
    const std::size_t step = std::max<std::size_t>(1, pixels.size() / kTimedPoints);
    const RandomStream stream("render-time", 1);
    double least = HUGE_VAL;
    for (int repetition = 0; repetition < 3; ++repetition) {
      double count = 0.0;
      const double begin = thread_seconds();
      for (std::size_t i = 0; i < pixels.size(); i += step, ++count) {
        estimator.integrate(pixels[i].point, stream.substream(i), {0, samples}, {});
      }
      least = std::min(least, (thread_seconds() - begin) / count);
    }
    return least;
  }

  /// As many samples as take so long, found by doubling and by a straight line from there; the
  /// fewest that make an estimate if one takes longer.
  std::uint64_t samples_within(std::span<const Pixel> pixels, double seconds) const {
    const std::uint64_t fewest = info->samples_per_estimate;
    if (info->ignores_budget) return 1;
    std::uint64_t samples = fewest;
    double taken = point_seconds(pixels, samples);
    while (taken < 0.5 * seconds && 2 * samples <= kMostSamples) {
      samples *= 2;
      taken = point_seconds(pixels, samples);
    }
    const double wanted = static_cast<double>(samples) * seconds / taken;
    const auto estimates = static_cast<std::uint64_t>(wanted / static_cast<double>(fewest));
    return fewest * std::max<std::uint64_t>(1, estimates);
  }
};

/// A receiver of one material under one map, and the picture that all others are held against.
class Studio {
 public:
  Studio(const EnvironmentMap& map, const PicturedScene& scene, const RenderOptions& options)
      : map_(&map),
        options_(&options),
        receiver_(&receiver_by_name(scene.receiver)),
        material_name_(scene.material),
        material_(material_of(scene.material)),
        scene_(receiver_->content),
        pixels_(visible_pixels(*receiver_, scene_, options.picture)) {}

  bool is_served_by(const EstimatorInfo& info) const { return info.serves(material_); }

  void render_reference(const EstimatorInfo& info, const PreparedEstimator& prepared) {
    reference_ = render({&info, prepared.bind(scene_, material_)}, options_->reference_samples,
                        "render-reference");
  }

  RenderRecord record_of(const EstimatorInfo& info, const PreparedEstimator& prepared) const {
    const Painter painter{&info, prepared.bind(scene_, material_)};
    RenderRecord record;
    record.map = map_->name;
    record.receiver = receiver_->name;
    record.material = material_name_;
    record.estimator = info.name;
    record.is_representative = info.is_representative;
    record.samples = painter.samples_within(pixels_, options_->point_seconds);
    record.point_seconds = painter.point_seconds(pixels_, record.samples);
    const auto start = std::chrono::steady_clock::now();
    record.picture = render(painter, record.samples, "render");
    record.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    record.reference = reference_;
    record.reference_samples = options_->reference_samples;
    compare(record, pixels_, map_->weights);
    return record;
  }

 private:
  Grid<Rgb> render(const Painter& painter, std::uint64_t samples, std::string_view purpose) const {
    const RandomStream stream(fmt::format("{}/{}/{}", purpose, map_->name, painter.info->name),
                              options_->seed);
    return render_picture(*map_, scene_, *receiver_, options_->picture, stream,
                          [&](const ShadingPoint& at, const RandomStream& of_pixel) {
                            return painter.estimator.integrate(at, of_pixel, {0, samples}, {});
                          });
  }

  const EnvironmentMap* map_;
  const RenderOptions* options_;
  const ReceiverInfo* receiver_;
  std::string material_name_;
  Material material_;
  Scene scene_;
  std::vector<Pixel> pixels_;
  Grid<Rgb> reference_;
};

/// All scenes of a map; every estimator is prepared once.
std::vector<RenderRecord> renders_of(const EnvironmentMap& map, const RenderOptions& options) {
  std::vector<std::unique_ptr<Studio>> studios;
  const EstimatorInfo& best = estimator_by_name(kReferenceEstimator);
  {
    const PreparedEstimator prepared = best.prepare(map);
    for (const PicturedScene& scene : kScenes) {
      studios.push_back(std::make_unique<Studio>(map, scene, options));
      studios.back()->render_reference(best, prepared);
    }
  }
  std::vector<std::vector<RenderRecord>> by_scene(studios.size());
  for (const EstimatorInfo* info : pictured(options)) {
    const PreparedEstimator prepared = info->prepare(map);
    for (std::size_t i = 0; i < studios.size(); ++i) {
      if (studios[i]->is_served_by(*info)) {
        by_scene[i].push_back(studios[i]->record_of(*info, prepared));
      }
    }
  }
  std::vector<RenderRecord> records;
  for (auto& scene : by_scene) std::move(scene.begin(), scene.end(), std::back_inserter(records));
  return records;
}

}  // namespace

std::vector<RenderRecord> study_renders(std::span<const EnvironmentMap> maps,
                                        const RenderOptions& options, const Progress& progress) {
  std::vector<RenderRecord> records;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    auto of_map = renders_of(maps[i], options);
    std::move(of_map.begin(), of_map.end(), std::back_inserter(records));
    if (progress) {
      progress("renders", static_cast<double>(i + 1) / static_cast<double>(maps.size()));
    }
  }
  return records;
}

}  // namespace lightproof
