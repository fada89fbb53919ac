#include "lightproof/prefilter/sampled_irradiance.h"

#include <fmt/format.h>

#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/random_batch.h"

namespace lightproof {

IrradianceMap cosine_sampled_irradiance_map(const EnvironmentMap& source, Extent normals,
                                            int samples, std::uint64_t seed) {
  if (samples < 1) {
    throw InputError(fmt::format("{} samples for each normal: at least 1 needed", samples));
  }
  IrradianceMap map = dark_irradiance_map(normals);
  const NearestRadiance radiance(source);
  const RandomStream stream("prefilter/cosine-sampled irradiance", seed);
  parallel_for(static_cast<std::size_t>(normals.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    std::vector<SquarePoint> points(static_cast<std::size_t>(samples));
    for (int x = 0; x < normals.width; ++x) {
      const std::uint64_t texel =
          row * static_cast<std::uint64_t>(normals.width) + static_cast<std::uint64_t>(x);
      fill_points(stream.substream(texel), 0, points);
      map.irradiance(x, y) =
          cosine_sampled_irradiance(radiance, normal_of_texel(normals, x, y), points).rgb;
    }
  });
  return map;
}

}  // namespace lightproof
