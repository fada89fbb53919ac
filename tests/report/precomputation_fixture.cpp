#include "precomputation_fixture.h"

#include <cmath>

#include "lightproof/core/measure.h"

namespace lightproof::testing {
namespace {

/// A sky with a sun and a coloured band around the horizon, which tells directions apart.
Rgb sky(Direction d) {
  const double up = d.z > 0.0 ? 0.4 + 0.6 * d.z : 0.15;
  const double azimuth = std::atan2(d.y, d.x);
  const double band = std::exp(-50.0 * d.z * d.z);
  const Direction sun = glm::normalize(Direction(0.5, 0.6, 0.5));
  const double light = 300.0 * std::exp(400.0 * (glm::dot(d, sun) - 1.0));
  return {up * 0.5 + band * (1.0 + std::cos(azimuth)) + light,
          up * 0.8 + band * (1.0 + std::cos(azimuth - 2.0)) + 0.9 * light,
          up * 1.2 + band * (1.0 + std::cos(azimuth + 2.0)) + 0.7 * light};
}

Grid<Rgb> halved(const Grid<Rgb>& from, Extent extent) {
  Grid<Rgb> small(extent);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const int right = std::min(2 * x + 1, from.extent().width - 1);
      const int below = std::min(2 * y + 1, from.extent().height - 1);
      small(x, y) = 0.25F * (from(2 * x, 2 * y) + from(right, 2 * y) + from(2 * x, below) +
                             from(right, below));
    }
  }
  return small;
}

Grid<Rgb> face_of(Projection projection, Extent extent, int face) {
  Grid<Rgb> texels(extent);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      texels(x, y) = sky(direction_of(projection, extent, {face, x, y}));
    }
  }
  return texels;
}

MapLevels pyramid(Projection projection, Extent base, int levels) {
  MapLevels map = {.projection = projection, .levels = {}};
  for (int i = 0; i < levels; ++i) {
    MapLevel level = {.roughness = levels > 1 ? i / (levels - 1.0) : 0.0, .faces = {}};
    for (int face = 0; face < info(projection).faces; ++face) {
      const auto number = static_cast<std::size_t>(face);
      level.faces.push_back(i == 0
                                ? face_of(projection, base, face)
                                : halved(map.levels.back().faces[number], level_extent(base, i)));
    }
    map.levels.push_back(level);
  }
  map.attributes = {{"method", "means of four texels"},
                    {"samples", "1024"},
                    {"source", "<script>alert(\"x\")</script>"},
                    {"command",
                     "lightproof precompute city.exr -o maps --specular --levels 9 "
                     "--projection cube --format ktx2"}};
  return map;
}

PrecomputedMap specular(std::string name, Projection projection, Extent base, int levels) {
  PrecomputedMap made = {.name = std::move(name), .map = pyramid(projection, base, levels)};
  for (int i = 0; i < levels; ++i) {
    const double error = 0.0002 * std::exp2(i);
    made.errors.push_back(LevelError{error, 0.9 * error, 1.2 * error, 256});
  }
  made.files = {made.name + ".ktx2"};
  return made;
}

PrecomputedMap irradiance() {
  PrecomputedMap made = {.name = "irradiance", .map = pyramid(Projection::lat_long, {64, 32}, 1)};
  made.map.levels[0].roughness.reset();
  made.files = {"irradiance.exr"};
  made.notes = {
      "12 values are above 65504, the largest that KTX 2.0 holds: up to 100000 (level 0, "
      "column 3, row 5). They were set to it."};
  return made;
}

PrecomputedBrdfMap brdf_map() {
  Grid<glm::vec2> values({128, 128});
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) {
      const float cosine = (static_cast<float>(x) + 0.5F) / 128.0F;
      const float roughness = (static_cast<float>(y) + 0.5F) / 128.0F;
      const float b = std::pow(1.0F - cosine, 5.0F) * (1.0F - roughness);
      values(x, y) = {1.0F - 0.6F * roughness - b, b};
    }
  }
  return {.name = "brdf",
          .map = {.values = values, .attributes = {{"method", "made up"}}},
          .error = LevelError{0.00005, 0.00004, 0.00007, 512},
          .files = {"brdf.ktx2"}};
}

}  // namespace

Precomputation synthetic_precomputation() {
  return {.source = "city <b>2</b>.exr",
          .maps = {specular("specular", Projection::cube, {128, 128}, 8),
                   specular("reflectivity", Projection::lat_long, {512, 256}, 9), irradiance()},
          .brdf_map = brdf_map(),
          .error_measure =
              "root mean square over texels drawn at random, relative to the mean of the "
              "level; in brackets its 95 % limits.",
          .version = "1.2.3"};
}

}  // namespace lightproof::testing
