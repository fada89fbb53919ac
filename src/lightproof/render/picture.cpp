#include "lightproof/render/picture.h"

#include <algorithm>

#include "lightproof/core/parallel.h"
#include "lightproof/image/lat_long_texels.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

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

Grid<Rgb> render_picture(const EnvironmentMap& map, const Scene& scene,
                         const ReceiverInfo& receiver, Extent extent, const RandomStream& stream,
                         const Shade& shade) {
  require_lat_long(map, "a render");
  Grid<Rgb> picture = backdrop(map.radiance, extent);
  const std::vector<Pixel> pixels = visible_pixels(receiver, scene, extent);
  constexpr std::size_t kPixelsPerTask = 64;
  const std::size_t tasks = (pixels.size() + kPixelsPerTask - 1) / kPixelsPerTask;
  parallel_for(tasks, [&](std::size_t task) {
    const std::size_t end = std::min(pixels.size(), (task + 1) * kPixelsPerTask);
    for (std::size_t i = task * kPixelsPerTask; i < end; ++i) {
      picture(pixels[i].x, pixels[i].y) = shade(pixels[i].point, stream.substream(i));
    }
  });
  return picture;
}

}  // namespace lightproof
