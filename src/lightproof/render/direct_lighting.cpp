#include "lightproof/render/direct_lighting.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <variant>

#include "lightproof/core/random_batch.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/warp/lat_long.h"
#include "lightproof/warp/sphere_batch.h"

namespace lightproof {
template <class Surface>
void LightBatch::fill_from_material(std::size_t count, const Surface& surface,
                                    const ShadingPoint& at) {
  assert(count <= kCapacity);
  count_ = count;
  for (std::size_t i = 0; i < count; ++i) {
    const auto [direction, scattering] = surface.sample(at, points_[i]);
    x_[i] = direction.x;
    y_[i] = direction.y;
    z_[i] = direction.z;
    pdf_[i] = scattering.pdf.value;
    reflected_cosine_[i] = scattering.reflected_cosine;
  }
}

/// With density 1/4pi.
void LightBatch::fill_from_sphere(std::size_t count) {
  assert(count <= kCapacity);
  count_ = count;
  uniform_directions(std::span(s_).first(count), std::span(u_).first(count),
                     {std::span(x_).first(count), std::span(y_).first(count),
                      std::span(z_).first(count), std::span(t_).first(count)});
  std::fill_n(pdf_.begin(), count, 1.0 / kSphere);
}

void LightBatch::fill_from_map(std::size_t count, const GuideTable& sampler,
                               const RandomStream& stream, std::uint64_t first) {
  assert(count <= kCapacity);
  count_ = count;
  sample_directions(sampler, stream, first,
                    {std::span(x_).first(count), std::span(y_).first(count),
                     std::span(z_).first(count), std::span(pdf_).first(count),
                     std::span(column_).first(count), std::span(row_).first(count)});
}

void LightBatch::draw(const Lighting& lighting, const ShadingPoint& at, const RandomStream& stream,
                      std::uint64_t first, std::size_t count) {
  switch (lighting.strategy) {
    case Strategy::uniform:
      fill_points(stream, first, std::span(s_).first(count), std::span(u_).first(count));
      return fill_from_sphere(count);
    case Strategy::material:
      fill_points(stream, first, std::span(points_).first(count));
      return std::visit([&](const auto& surface) { fill_from_material(count, surface, at); },
                        lighting.material);
    case Strategy::environment_a:
      return fill_from_map(count, lighting.light->sampler(Weighting::A), stream, first);
    case Strategy::environment_b:
      return fill_from_map(count, lighting.light->sampler(Weighting::B), stream, first);
  }
}

void LightBatch::locate(Strategy strategy, Extent map) {
  switch (strategy) {
    case Strategy::uniform:
      for (std::size_t i = 0; i < count_; ++i) {
        column_[i] = cell_of(s_[i], map.width);
        row_[i] = cell_of(t_[i], map.height);
      }
      return;
    case Strategy::material:
      for (std::size_t i = 0; i < count_; ++i) {
        const SquarePoint at = approximate_square_from_direction({x_[i], y_[i], z_[i]});
        column_[i] = cell_of(at.s, map.width);
        row_[i] = cell_of(at.t, map.height);
      }
      return;
    case Strategy::environment_a:
    case Strategy::environment_b:
      return;  // the sampler says where
  }
}

void LightBatch::weigh(const Material& material, const ShadingPoint& at) {
  std::visit(
      // Copies, which no store in the loop can change: what depends on them alone is done once.
      [this, at](const auto surface) {
        for (std::size_t i = 0; i < count_; ++i) {
          reflected_cosine_[i] = surface.evaluate(at, direction(i)).reflected_cosine;
        }
      },
      material);
}

void LightBatch::shade(const Lighting& lighting, const ShadingPoint& at) {
  const Grid<Rgb>& radiance = lighting.light->map().radiance;
  locate(lighting.strategy, radiance.extent());
  if (lighting.strategy != Strategy::material) weigh(lighting.material, at);
  const auto width = static_cast<std::size_t>(radiance.extent().width);
  // Every sample is written; those that do not matter are overwritten by the next.
  ray_count_ = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    estimates_[i] = Rgb(0.0F);
    rays_[ray_count_] = shadow_ray(at.position, direction(i));
    arrivals_[ray_count_] = {radiance.values().data() + static_cast<std::size_t>(row_[i]) * width +
                                 static_cast<std::size_t>(column_[i]),
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
