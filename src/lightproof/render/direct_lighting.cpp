#include "lightproof/render/direct_lighting.h"

#include <cassert>
#include <variant>

#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

LightSample from_environment(const BinarySearch& sampler, SquarePoint u) {
  const TexelSample drawn = sampler.sample(u);
  return {direction_from_square(drawn.at), to_solid_angle(drawn.pdf, drawn.at).value, drawn.x,
          drawn.y};
}

/// With density 1/4pi: cos(theta) uniform, so the place on the map needs no inverse of a warp but
/// one arc cosine.
LightSample from_sphere(Extent map, SquarePoint u) {
  const SquarePoint at = {u.s, std::acos(1.0 - 2.0 * u.t) / kPi};
  return {direction_from_square(at), 1.0 / kSphere, cell_of(at.s, map.width),
          cell_of(at.t, map.height)};
}

template <class Surface>
LightSample from_material(const Surface& surface, const ShadingPoint& at, SquarePoint u) {
  const DirectionSample drawn = surface.sample(at, u);
  return {drawn.direction, drawn.pdf.value, -1, -1};
}

/// Directions drawn from the material find their texel when it is known that they count.
void locate(LightSample& sample, Extent map) {
  const SquarePoint at = approximate_square_from_direction(sample.direction);
  sample.x = cell_of(at.s, map.width);
  sample.y = cell_of(at.t, map.height);
}

}  // namespace

template <class Draw>
void LightBatch::fill(const RandomStream& stream, std::uint64_t first, std::size_t count,
                      const Draw& draw) {
  assert(count <= kCapacity);
  count_ = count;
  for (std::size_t i = 0; i < count; ++i) samples_[i] = draw(stream.point(first + i));
}

void LightBatch::draw(const Lighting& lighting, const ShadingPoint& at, const RandomStream& stream,
                      std::uint64_t first, std::size_t count) {
  const EnvironmentLight& light = *lighting.light;
  switch (lighting.strategy) {
    case Strategy::uniform:
      return fill(stream, first, count, [extent = light.map().radiance.extent()](SquarePoint u) {
        return from_sphere(extent, u);
      });
    case Strategy::material:
      return std::visit(
          [&](const auto& surface) {
            fill(stream, first, count,
                 [&](SquarePoint u) { return from_material(surface, at, u); });
          },
          lighting.material);
    case Strategy::environment_a:
    case Strategy::environment_b: {
      const bool a = lighting.strategy == Strategy::environment_a;
      const BinarySearch& sampler = light.sampler(a ? Weighting::A : Weighting::B);
      return fill(stream, first, count,
                  [&](SquarePoint u) { return from_environment(sampler, u); });
    }
  }
}

void LightBatch::shade(const Lighting& lighting, const ShadingPoint& at) {
  const Grid<Rgb>& radiance = lighting.light->map().radiance;
  ray_count_ = 0;
  std::visit(
      [&](const auto& surface) {
        for (std::size_t i = 0; i < count_; ++i) {
          LightSample& sample = samples_[i];
          const double k = surface.reflected_cosine(at, sample.direction);
          estimates_[i] = Rgb(0.0F);
          if (!(k > 0.0 && sample.pdf > 0.0)) continue;
          if (sample.x < 0) locate(sample, radiance.extent());
          arrivals_[ray_count_] = {&radiance(sample.x, sample.y),
                                   static_cast<float>(k / sample.pdf),
                                   static_cast<std::uint32_t>(i)};
          __builtin_prefetch(arrivals_[ray_count_].radiance);
          rays_[ray_count_++] = shadow_ray(at.position, sample.direction);
        }
      },
      lighting.material);
}

std::span<const Rgb> LightBatch::resolve() {
  for (std::size_t i = 0; i < ray_count_; ++i) {
    const Arrival& arrival = arrivals_[i];
    if (!is_blocked(rays_[i])) estimates_[arrival.sample] = *arrival.radiance * arrival.weight;
  }
  return {estimates_.data(), count_};
}

std::span<const Rgb> LightBatch::estimate(const Lighting& lighting, const ShadingPoint& at,
                                          const RandomStream& stream, std::uint64_t first,
                                          std::size_t count) {
  draw(lighting, at, stream, first, count);
  shade(lighting, at);
  trace(*lighting.scene);
  return resolve();
}

}  // namespace lightproof
