#include "lightproof/image/map_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string_view>

#include "lightproof/core/atomic_file.h"
#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/image/exr_writer.h"
#include "lightproof/image/ktx2_writer.h"
#include "lightproof/image/radiance_writer.h"
#include "lightproof/image/stored_value.h"
#include "lightproof/image/writer.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 6> kFaceNames = {"px", "nx", "py", "ny", "pz", "nz"};

/// All levels and faces are in one file.
bool is_one_file(Projection projection, MapFormat format) {
  return format == MapFormat::ktx2 || (format == MapFormat::exr && !is_cube(projection));
}

std::string name_of_file(const std::string& stem, MapFormat format) {
  return fmt::format("{}.{}", stem, info(format).name);
}

std::string name_of_face(const std::string& stem, Projection projection, int levels, int level,
                         int face, MapFormat format) {
  const std::string of_level = levels > 1 ? fmt::format("_m{}", level) : "";
  const std::string of_face =
      is_cube(projection) ? fmt::format("_{}", kFaceNames[static_cast<std::size_t>(face)]) : "";
  return name_of_file(stem + of_level + of_face, format);
}

/// c / (1 + c), sRGB-encoded.
Grid<Rgb> tone_mapped_by_reinhard(const Grid<Rgb>& linear) {
  Grid<Rgb> picture(linear.extent());
  const auto encoded = [](float v) { return static_cast<float>(tone_mapped_byte(v)) / 255.0F; };
  parallel_for(static_cast<std::size_t>(linear.extent().height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    std::ranges::transform(linear.row(y), picture.row(y).begin(), [&](Rgb rgb) {
      return Rgb(encoded(rgb.r), encoded(rgb.g), encoded(rgb.b));
    });
  });
  return picture;
}

std::string bytes_of_face(const MapLevels& map, int level, int face, MapFormat format) {
  const Grid<Rgb>& texels =
      map.levels[static_cast<std::size_t>(level)].faces[static_cast<std::size_t>(face)];
  Attributes attributes = attributes_of(map, level, face);
  switch (format) {
    case MapFormat::hdr:
      return radiance_bytes(texels, attributes, map.chromaticities);
    case MapFormat::png:
      attributes.push_back({"transfer", "c / (1 + c) of each channel c (Reinhard), sRGB-encoded"});
      return png_bytes(tone_mapped_by_reinhard(texels), attributes);
    case MapFormat::exr:
    case MapFormat::ktx2:
      break;
  }
  return exr_bytes(texels, attributes, map.chromaticities);
}

void require_finite(const std::string& file, const BrdfMap& map) {
  for (const glm::vec2 ab : map.values.values()) {
    if (std::isfinite(ab.x) && std::isfinite(ab.y)) continue;
    throw InputError(fmt::format("{}: not written: a texel is ({}, {}), finite values are needed",
                                 file, ab.x, ab.y));
  }
}

}  // namespace

std::vector<std::string> map_file_names(const std::string& stem, Projection projection, int levels,
                                        MapFormat format) {
  if (is_one_file(projection, format)) return {name_of_file(stem, format)};
  std::vector<std::string> names;
  for (int level = 0; level < levels; ++level) {
    for (int face = 0; face < info(projection).faces; ++face) {
      names.push_back(name_of_face(stem, projection, levels, level, face, format));
    }
  }
  return names;
}

void write_map(const fs::path& folder, const std::string& stem, const MapLevels& map,
               MapFormat format, OutOfRange out_of_range) {
  assert(is_pyramid(map));
  const int levels = static_cast<int>(map.levels.size());
  const std::vector<std::string> names = map_file_names(stem, map.projection, levels, format);
  check_range((folder / names.front()).string(), format, map, out_of_range);
  if (is_one_file(map.projection, format)) {
    const bool is_ktx2 = format == MapFormat::ktx2;
    write_file(folder / names.front(), is_ktx2 ? ktx2_bytes(map) : exr_mipmap_bytes(map));
    return;
  }
  for (int i = 0; i < static_cast<int>(names.size()); ++i) {
    const int faces = info(map.projection).faces;
    write_file(folder / names[static_cast<std::size_t>(i)],
               bytes_of_face(map, i / faces, i % faces, format));
  }
}

bool holds_brdf_map(MapFormat format) { return format != MapFormat::hdr; }

MapFormat brdf_format(MapFormat format) { return holds_brdf_map(format) ? format : MapFormat::exr; }

void write_brdf_map(const fs::path& folder, const std::string& stem, const BrdfMap& map,
                    MapFormat format) {
  const fs::path file = folder / name_of_file(stem, format);
  if (!holds_brdf_map(format)) {
    throw InputError(
        fmt::format("{}: not written: a BRDF integration map needs more digits than {} "
                    "has: exr, ktx2 or png",
                    file.string(), info(format).title));
  }
  require_finite(file.string(), map);
  if (format == MapFormat::ktx2) return write_file(file, ktx2_bytes(map));
  if (format == MapFormat::exr) return write_file(file, exr_bytes(map));
  Attributes attributes = attributes_of(map);
  attributes.push_back({"transfer", "none: values are 1/255 of the bytes, A in red, B in green"});
  write_file(file, png_bytes(picture_of(map), attributes));
}

}  // namespace lightproof
