#include "lightproof/render/direct_lighting.h"

#include <algorithm>
#include <cassert>

#include "lightproof/materials/material_batch.h"
#include "lightproof/warp/lat_long.h"
#include "lightproof/warp/sphere_batch.h"

namespace lightproof {

void LightBatch::fill_from_material(std::size_t count, const Material& material,
                                    const ShadingPoint& at) {
  sample_material(
      material, at, std::span(s_).first(count), std::span(u_).first(count),
      {std::span(x_).first(count), std::span(y_).first(count), std::span(z_).first(count),
       std::span(pdf_).first(count), std::span(reflected_cosine_).first(count)});
}

/// The density is 1/4pi.
void LightBatch::fill_from_sphere(std::size_t count) {
  uniform_directions(std::span(s_).first(count), std::span(u_).first(count),
                     {std::span(x_).first(count), std::span(y_).first(count),
                      std::span(z_).first(count), std::span(t_).first(count)});
  std::fill_n(pdf_.begin(), count, 1.0 / kSphere);
}

void LightBatch::fill_from_map(std::size_t count, const GuideTable& sampler,
                               const BatchPoints& points) {
  draw_batch(sampler, points,
             DirectionBatch{std::span(x_).first(count), std::span(y_).first(count),
                            std::span(z_).first(count), std::span(pdf_).first(count),
                            std::span(column_).first(count), std::span(row_).first(count)});
}

void LightBatch::draw(const Lighting& lighting, const ShadingPoint& at, const BatchPoints& points,
                      std::size_t count) {
  assert(count <= kCapacity);
  count_ = count;
  if (const auto& sampler = lighting.light->sampler()) {
    return fill_from_map(count, *sampler, points);
  }
  points.fill(0, std::span(s_).first(count), std::span(u_).first(count));
  if (std::holds_alternative<MaterialLobes>(lighting.light->source())) {
    return fill_from_material(count, lighting.material, at);
  }
  fill_from_sphere(count);
}

void LightBatch::locate(Extent map) {
  for (std::size_t i = 0; i < count_; ++i) {
    column_[i] = cell_of(s_[i], map.width);
    row_[i] = cell_of(t_[i], map.height);
  }
}

void LightBatch::shade(const Lighting& lighting, const ShadingPoint& at) {
  const Grid<Rgb>& radiance = lighting.light->map().radiance;
  const DirectionArrays directions = {std::span(x_).first(count_), std::span(y_).first(count_),
                                      std::span(z_).first(count_)};
  if (std::holds_alternative<MaterialLobes>(lighting.light->source())) {
    approximate_positions(directions.x, directions.y, directions.z,
                          {std::span(s_).first(count_), std::span(t_).first(count_)});
  } else {
    reflected_cosines(lighting.material, at, directions,
                      std::span(reflected_cosine_).first(count_));
  }
  if (!lighting.light->sampler()) locate(radiance.extent());
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
                                          const BatchPoints& points, std::size_t count) {
  draw(lighting, at, points, count);
  shade(lighting, at);
  trace(*lighting.scene);
  return resolve();
}

}  // namespace lightproof
