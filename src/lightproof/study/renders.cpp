#include "lightproof/study/renders.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "lightproof/estimators/registry.h"
#include "lightproof/render/picture.h"

namespace lightproof {
namespace {

constexpr std::string_view kReceiver = "sphere-on-plane";
constexpr std::string_view kMaterial = "phong";
/// The estimator with which references are rendered.
constexpr std::string_view kReferenceEstimator = "environment B";

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

}  // namespace

std::vector<RenderRecord> study_renders(std::span<const EnvironmentMap> maps,
                                        const RenderOptions& options, const Progress& progress) {
  const ReceiverInfo& receiver = receiver_by_name(kReceiver);
  const MaterialInfo& material = material_by_name(kMaterial);
  const Scene scene(receiver.content);
  const std::vector<Pixel> pixels = visible_pixels(receiver, scene, options.picture);
  std::vector<RenderRecord> records;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const EnvironmentMap& map = maps[i];
    const auto bound_to_scene = [&](const EstimatorInfo& info) {
      return info.prepare(map).bind(scene, material.material);
    };
    const auto render = [&](const EstimatorInfo& info, const BoundEstimator& estimator,
                            std::uint64_t samples, std::string_view purpose) {
      const RandomStream stream(fmt::format("{}/{}/{}", purpose, map.name, info.name),
                                options.seed);
      return render_picture(map, scene, receiver, options.picture, stream,
                            [&](const ShadingPoint& at, const RandomStream& of_pixel) {
                              return estimator.integrate(at, of_pixel, {0, samples}, {});
                            });
    };
    const EstimatorInfo& best = estimator_by_name(kReferenceEstimator);
    const Grid<Rgb> reference =
        render(best, bound_to_scene(best), options.reference_samples, "render-reference");
    for (const EstimatorInfo& info : estimators()) {
      if (!info.is_studied || !info.serves(material.material)) continue;
      const BoundEstimator estimator = bound_to_scene(info);  // set-up is not rendering
      const auto start = std::chrono::steady_clock::now();
      RenderRecord record;
      record.picture = render(info, estimator, options.samples, "render");
      record.seconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      record.map = map.name;
      record.receiver = receiver.name;
      record.material = material.name;
      record.estimator = info.name;
      record.samples = options.samples;
      record.reference = reference;
      record.reference_samples = options.reference_samples;
      compare(record, pixels, map.weights);
      records.push_back(std::move(record));
    }
    if (progress) {
      progress("renders", static_cast<double>(i + 1) / static_cast<double>(maps.size()));
    }
  }
  return records;
}

}  // namespace lightproof
