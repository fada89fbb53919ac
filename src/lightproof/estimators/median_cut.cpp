#include "lightproof/estimators/median_cut.h"

#include <algorithm>
#include <vector>

#include "lightproof/estimators/light_samples.h"
#include "lightproof/estimators/texel_directions.h"
#include "lightproof/image/lat_long_texels.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// Columns x0 … x1 - 1 and rows y0 … y1 - 1 of the map.
struct Region {
  int x0;
  int x1;
  int y0;
  int y1;

  bool is_texel() const { return x1 - x0 == 1 && y1 - y0 == 1; }
};

/// Luminance times solid angle, summed from the map's first texel on (Crow 1984).
class SummedAreas {
 public:
  explicit SummedAreas(const EnvironmentMap& map)
      : sums_({map.radiance.extent().width + 1, map.radiance.extent().height + 1}) {
    const auto [width, height] = map.radiance.extent();
    for (int y = 0; y < height; ++y) {
      const double area = texel_solid_angle({width, height}, y);
      double row = 0.0;
      for (int x = 0; x < width; ++x) {
        row += area * luminance_of(map.radiance(x, y), map.weights);
        sums_(x + 1, y + 1) = sums_(x + 1, y) + row;
      }
    }
  }

  double power(const Region& r) const {
    return (sums_(r.x1, r.y1) - sums_(r.x0, r.y1)) - (sums_(r.x1, r.y0) - sums_(r.x0, r.y0));
  }

 private:
  Grid<double> sums_;
};

/// The place between first and last at which a function of it, which grows, is nearest to half of
/// its value at the end.
template <class Power>
int halving(int first, int end, const Power& power_until) {
  const double half = 0.5 * power_until(end);
  int low = first + 1;
  int high = end - 1;
  while (low < high) {
    const int middle = low + (high - low) / 2;
    if (power_until(middle) < half) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  if (low > first + 1 && half - power_until(low - 1) < power_until(low) - half) --low;
  return low;
}

/// Cuts a region in two, along its longer side; a single texel stays what it is.
void cut(const Region& region, Extent extent, const SummedAreas& sums,
         std::vector<Region>& regions) {
  if (region.is_texel()) return regions.push_back(region);
  const double sine = sin_theta(0.5 * (region.y0 + region.y1) / extent.height);
  const double across = 2.0 * (region.x1 - region.x0) * sine / extent.width;
  const double along = static_cast<double>(region.y1 - region.y0) / extent.height;
  const bool by_columns =
      region.y1 - region.y0 == 1 || (region.x1 - region.x0 > 1 && across > along);
  Region first = region;
  Region second = region;
  if (by_columns) {
    first.x1 = second.x0 = halving(region.x0, region.x1, [&](int x) {
      return sums.power({region.x0, x, region.y0, region.y1});
    });
  } else {
    first.y1 = second.y0 = halving(region.y0, region.y1, [&](int y) {
      return sums.power({region.x0, region.x1, region.y0, y});
    });
  }
  regions.push_back(first);
  regions.push_back(second);
}

DirectedLight light_of(const Region& region, const EnvironmentMap& map,
                       const TexelDirections& centres) {
  const Extent extent = map.radiance.extent();
  glm::dvec3 mean(0.0);
  glm::dvec3 flux(0.0);
  for (int y = region.y0; y < region.y1; ++y) {
    const double area = texel_solid_angle(extent, y);
    for (int x = region.x0; x < region.x1; ++x) {
      const Rgb radiance = map.radiance(x, y);
      mean += area * luminance_of(radiance, map.weights) * centres.at(x, y);
      flux += area * glm::dvec3(radiance);
    }
  }
  const double length = glm::length(mean);
  if (length > 0.0) return {mean / length, flux};
  return {direction_from_square({0.5 * (region.x0 + region.x1) / extent.width,
                                 0.5 * (region.y0 + region.y1) / extent.height}),
          flux};
}

/// What is added up at a point: lights as samples of the density 1, a mean over which is a sum.
Rgb sum_of(std::span<const DirectedLight> lights, const Scene& scene, const Material& material,
           const EnvironmentMap& map, const ShadingPoint& at) {
  LightSamples samples;
  Arrivals arrivals;
  samples.has_light = true;
  glm::dvec3 sum(0.0);
  for (std::size_t done = 0; done < lights.size(); done += LightSamples::kCapacity) {
    samples.count = std::min(lights.size() - done, LightSamples::kCapacity);
    for (std::size_t i = 0; i < samples.count; ++i) {
      samples.set(i, lights[done + i].direction);
      samples.light[i] = Rgb(lights[done + i].flux);
      samples.pdf[i] = 1.0;
    }
    samples.reflect(material, at);
    for (const Rgb rgb : samples.estimates(scene, map.radiance, at.position, arrivals)) {
      sum += glm::dvec3(rgb);
    }
  }
  return Rgb(sum);
}

}  // namespace

std::vector<DirectedLight> median_cut(const EnvironmentMap& map, int cuts) {
  require_lat_long(map, "median cut");
  const Extent extent = map.radiance.extent();
  const SummedAreas sums(map);
  std::vector<Region> regions = {{0, extent.width, 0, extent.height}};
  for (int i = 0; i < cuts; ++i) {
    std::vector<Region> halves;
    for (const Region& region : regions) cut(region, extent, sums, halves);
    regions = std::move(halves);
  }
  const TexelDirections centres(cell_size(extent), 0.5, extent);
  std::vector<DirectedLight> lights;
  for (const Region& region : regions) {
    const DirectedLight light = light_of(region, map, centres);
    if (light.flux != glm::dvec3(0.0)) lights.push_back(light);
  }
  return lights;
}

PreparedEstimator median_cut_lights(const EnvironmentMap& map, int cuts) {
  const auto lights = std::make_shared<const std::vector<DirectedLight>>(median_cut(map, cuts));
  return {[&map, lights](const Scene& scene, const Material& material) -> BoundEstimator {
            return {[&map, lights, &scene, material](
                        const ShadingPoint& at, const RandomStream& /*stream*/, Budget /*budget*/,
                        const EachEstimate& /*each*/) {
              return sum_of(*lights, scene, material, map, at);
            }};
          },
          lights->size() * sizeof(DirectedLight)};
}

}  // namespace lightproof
