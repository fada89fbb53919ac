#include "lightproof/render/picture.h"

#include <algorithm>

#include "lightproof/core/parallel.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

Rgb mean_estimate(const Lighting& lighting, const ShadingPoint& at, const RandomStream& stream,
                  std::uint64_t samples) {
  LightBatch batch;
  glm::dvec3 sum(0.0);
  for (std::uint64_t first = 0; first < samples; first += LightBatch::kCapacity) {
    const auto count = std::min<std::uint64_t>(samples - first, LightBatch::kCapacity);
    for (const Rgb estimate : batch.estimate(lighting, at, stream, first, count)) {
      sum += glm::dvec3(estimate);
    }
  }
  return Rgb(sum / static_cast<double>(samples));
}

Grid<Rgb> backdrop(const Grid<Rgb>& radiance, Extent extent) {
  Grid<Rgb> picture(extent);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const SquarePoint at = square_from_direction(camera_ray(x, y, extent));
      picture(x, y) =
          radiance(cell_of(at.s, radiance.extent().width), cell_of(at.t, radiance.extent().height));
    }
  }
  return picture;
}

}  // namespace

Grid<Rgb> render_picture(const Lighting& lighting, const ReceiverInfo& receiver, Extent extent,
                         std::uint64_t samples, const RandomStream& stream) {
  Grid<Rgb> picture = backdrop(lighting.light->map().radiance, extent);
  const std::vector<Pixel> pixels = visible_pixels(receiver, *lighting.scene, extent);
  constexpr std::size_t kPixelsPerTask = 64;
  const std::size_t tasks = (pixels.size() + kPixelsPerTask - 1) / kPixelsPerTask;
  parallel_for(tasks, [&](std::size_t task) {
    const std::size_t end = std::min(pixels.size(), (task + 1) * kPixelsPerTask);
    for (std::size_t i = task * kPixelsPerTask; i < end; ++i) {
      picture(pixels[i].x, pixels[i].y) =
          mean_estimate(lighting, pixels[i].point, stream.substream(i), samples);
    }
  });
  return picture;
}

}  // namespace lightproof
