#include "lightproof/render/direct_lighting.h"

#include <cassert>
#include <variant>

#include "lightproof/core/random_batch.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// What drawing one sample yields.
struct Drawn {
  Direction direction;
  double pdf;
  double reflected_cosine;  ///< if the material drew it
  std::uint32_t texel;      ///< if the map or the sphere did
};

std::uint32_t texel_index(int x, int y, Extent map) {
  return static_cast<std::uint32_t>(y * map.width + x);
}

Drawn from_environment(const TexelSample& drawn, Extent map) {
  return {direction_from_square(drawn.at), to_solid_angle(drawn.pdf, drawn.at).value, 0.0,
          texel_index(drawn.x, drawn.y, map)};
}

/// With density 1/4pi: cos(theta) uniform, so the place on the map needs no inverse of a warp but
/// one arc cosine.
Drawn from_sphere(Extent map, SquarePoint u) {
  const SquarePoint at = {u.s, std::acos(1.0 - 2.0 * u.t) / kPi};
  return {direction_from_square(at), 1.0 / kSphere, 0.0,
          texel_index(cell_of(at.s, map.width), cell_of(at.t, map.height), map)};
}

template <class Surface>
Drawn from_material(const Surface& surface, const ShadingPoint& at, SquarePoint u) {
  const auto [direction, scattering] = surface.sample(at, u);
  return {direction, scattering.pdf.value, scattering.reflected_cosine, 0};
}

}  // namespace

template <class Draw>
void LightBatch::fill(std::size_t count, const Draw& draw) {
  assert(count <= kCapacity);
  count_ = count;
  for (std::size_t i = 0; i < count; ++i) {
    const Drawn drawn = draw(i);
    x_[i] = drawn.direction.x;
    y_[i] = drawn.direction.y;
    z_[i] = drawn.direction.z;
    pdf_[i] = drawn.pdf;
    reflected_cosine_[i] = drawn.reflected_cosine;
    texel_[i] = drawn.texel;
  }
}

void LightBatch::draw(const Lighting& lighting, const ShadingPoint& at, const RandomStream& stream,
                      std::uint64_t first, std::size_t count) {
  const Extent extent = lighting.light->map().radiance.extent();
  switch (lighting.strategy) {
    case Strategy::uniform:
      fill_points(stream, first, std::span(points_).first(count));
      return fill(count, [&](std::size_t i) { return from_sphere(extent, points_[i]); });
    case Strategy::material:
      fill_points(stream, first, std::span(points_).first(count));
      return std::visit(
          [&](const auto& surface) {
            fill(count, [&](std::size_t i) { return from_material(surface, at, points_[i]); });
          },
          lighting.material);
    case Strategy::environment_a:
    case Strategy::environment_b: {
      const bool a = lighting.strategy == Strategy::environment_a;
      sample(lighting.light->sampler(a ? Weighting::A : Weighting::B), stream, first,
             std::span(samples_).first(count));
      return fill(count, [&](std::size_t i) { return from_environment(samples_[i], extent); });
    }
  }
}

void LightBatch::locate(Extent map) {
  for (std::size_t i = 0; i < count_; ++i) {
    const SquarePoint at = approximate_square_from_direction({x_[i], y_[i], z_[i]});
    texel_[i] = texel_index(cell_of(at.s, map.width), cell_of(at.t, map.height), map);
  }
}

void LightBatch::shade(const Lighting& lighting, const ShadingPoint& at) {
  const Grid<Rgb>& radiance = lighting.light->map().radiance;
  if (lighting.strategy == Strategy::material) {
    locate(radiance.extent());
  } else {
    std::visit(
        // Copies, which no store in the loop can change: what depends on them alone is done once.
        [this, at](const auto surface) {
          for (std::size_t i = 0; i < count_; ++i) {
            reflected_cosine_[i] = surface.evaluate(at, direction(i)).reflected_cosine;
          }
        },
        lighting.material);
  }
  // Every sample is written; those that do not matter are overwritten by the next.
  ray_count_ = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    estimates_[i] = Rgb(0.0F);
    rays_[ray_count_] = shadow_ray(at.position, direction(i));
    arrivals_[ray_count_] = {radiance.values().data() + texel_[i],
                             static_cast<float>(reflected_cosine_[i] / pdf_[i]),
                             static_cast<std::uint32_t>(i)};
    __builtin_prefetch(arrivals_[ray_count_].radiance);
    ray_count_ += reflected_cosine_[i] > 0.0 && pdf_[i] > 0.0 ? 1 : 0;
  }
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
