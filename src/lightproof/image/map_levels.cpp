#include "lightproof/image/map_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

#include "lightproof/core/error.h"
#include "lightproof/image/picture_header.h"
#include "lightproof/image/writer.h"
#include "lightproof/warp/cube.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// The projections in the order of the enumeration.
constexpr std::array kProjections = {
    ProjectionInfo{
        Projection::lat_long, "latlong",
        "latitude-longitude, z up: u = 1/2 - atan2(y,x)/2pi, v = acos(z)/pi from the top", 1},
    ProjectionInfo{Projection::cube, "cube",
                   "cube faces +X, -X, +Y, -Y, +Z, -Z from their top left, as seen from inside: "
                   "(X, Y, Z) = (-x, z, -y) of axes with z up (three.js, Babylon.js)",
                   6},
    ProjectionInfo{Projection::mirrored_cube, "cube-mirrored",
                   "cube faces +X, -X, +Y, -Y, +Z, -Z from their top left, mirrored: (X, Y, Z) = "
                   "(x, z, -y) of axes with z up (Filament, glTF Sample Viewer)",
                   6},
};

bool is_level(const MapLevel& level, Extent extent, int faces) {
  return level.faces.size() == static_cast<std::size_t>(faces) &&
         std::ranges::all_of(level.faces,
                             [&](const Grid<Rgb>& face) { return face.extent() == extent; });
}

SquarePoint centre_of(Extent extent, LevelTexel texel) {
  return {(texel.column + 0.5) / extent.width, (extent.height - texel.row - 0.5) / extent.height};
}

LevelTexel lat_long_texel_at(Extent extent, Direction direction) {
  const SquarePoint at = square_from_direction(direction);
  const auto index = [](double coordinate, int size) {
    return std::clamp(static_cast<int>(coordinate * size), 0, size - 1);
  };
  return {0, index(at.s, extent.width), extent.height - 1 - index(at.t, extent.height)};
}

std::string size_text(Extent extent) { return fmt::format("{} x {}", extent.width, extent.height); }

std::string roughness_text(double roughness) { return fmt::format("{:.6g}", roughness); }

/// "0, 0.125, 0.25"; empty if no level has a roughness.
std::string roughness_list(const std::vector<MapLevel>& levels) {
  std::string text;
  for (const MapLevel& level : levels) {
    if (level.roughness) text += (text.empty() ? "" : ", ") + roughness_text(*level.roughness);
  }
  return text;
}

void add(Attributes& attributes, std::string name, std::string value) {
  if (!value.empty()) attributes.push_back({std::move(name), std::move(value)});
}

/// What files of all levels and of one face have in common.
Attributes common_attributes(const MapLevels& map) {
  Attributes attributes;
  add(attributes, "software", "Lightproof " LIGHTPROOF_VERSION);
  add(attributes, "projection", std::string(info(map.projection).description));
  if (map.chromaticities) add(attributes, "primaries", describe(*map.chromaticities));
  return attributes;
}

}  // namespace

std::span<const ProjectionInfo> projections() { return kProjections; }

const ProjectionInfo& info(Projection projection) {
  return kProjections[static_cast<std::size_t>(projection)];
}

std::optional<Projection> projection_by_name(std::string_view name) {
  const auto found = std::ranges::find(kProjections, name, &ProjectionInfo::name);
  if (found == kProjections.end()) return std::nullopt;
  return found->projection;
}

MapLevel lat_long_level(const Grid<Rgb>& map, std::optional<double> roughness) {
  return {roughness, {flip_rows(map)}};
}

bool is_pyramid(const MapLevels& map) {
  if (map.levels.empty() || map.levels.front().faces.empty()) return false;
  const Extent base = map.extent();
  if (is_cube(map.projection) && base.width != base.height) return false;
  if (map.levels.size() > static_cast<std::size_t>(most_levels(base))) return false;
  for (int i = 0; i < static_cast<int>(map.levels.size()); ++i) {
    const MapLevel& level = map.levels[static_cast<std::size_t>(i)];
    if (!is_level(level, level_extent(base, i), info(map.projection).faces)) return false;
  }
  return true;
}

Extent level_extent(Extent base, int level) {
  return {std::max(1, base.width >> level), std::max(1, base.height >> level)};
}

int most_levels(Extent base) {
  return static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(base.width, base.height))));
}

void check_map_size(Projection projection, Extent extent) {
  const auto [shorter, longer] = std::minmax(extent.width, extent.height);
  if (is_cube(projection)) {
    const int largest = kLargestPicture.height;
    if (shorter == longer && shorter >= 1 && longer <= largest) return;
    throw InputError(fmt::format("cube faces of {} texels: they are square, 1 x 1 to {} x {}",
                                 size_text(extent), largest, largest));
  }
  if (shorter >= 1 && longer <= kLargestPicture.width && shorter <= kLargestPicture.height) return;
  throw InputError(fmt::format("a map of {} texels: 1 x 1 to {} are possible", size_text(extent),
                               size_text(kLargestPicture)));
}

void check_level_count(Extent base, int levels) {
  const int most = most_levels(base);
  if (levels >= 1 && levels <= most) return;
  throw InputError(fmt::format("{} levels of {} texels: {}", levels, size_text(base),
                               most == 1
                                   ? std::string("there is only one")
                                   : fmt::format("1 to {} are possible, the last of 1 x 1", most)));
}

Direction direction_of(Projection projection, Extent extent, LevelTexel texel) {
  if (projection == Projection::lat_long) return direction_from_square(centre_of(extent, texel));
  const CubeTexel on_cube = {kCubeFaces[static_cast<std::size_t>(texel.face)], texel.column,
                             texel.row};
  const Direction direction = direction_of(on_cube, extent.width);
  return projection == Projection::cube ? direction : mirrored(direction);
}

LevelTexel texel_at(Projection projection, Extent extent, Direction direction) {
  if (projection == Projection::lat_long) return lat_long_texel_at(extent, direction);
  const CubeTexel texel =
      texel_at(projection == Projection::cube ? direction : mirrored(direction), extent.width);
  return {static_cast<int>(texel.face), texel.column, texel.row};
}

double solid_angle_of(Projection projection, Extent extent, LevelTexel texel) {
  if (projection == Projection::lat_long) {
    return texel_solid_angle(extent, extent.height - 1 - texel.row);
  }
  return cube_texel_solid_angle(extent.width, texel.column, texel.row);
}

Attributes attributes_of(const MapLevels& map) {
  Attributes attributes = common_attributes(map);
  add(attributes, "levels", std::to_string(map.levels.size()));
  add(attributes, "roughness", roughness_list(map.levels));
  return merged(std::move(attributes), map.attributes);
}

Attributes attributes_of(const MapLevels& map, int level, int face) {
  Attributes attributes = common_attributes(map);
  if (is_cube(map.projection)) {
    add(attributes, "face", std::string(name_of(kCubeFaces[static_cast<std::size_t>(face)])));
  }
  add(attributes, "level", fmt::format("{} of 0 to {}", level, map.levels.size() - 1));
  const std::optional<double> roughness = map.levels[static_cast<std::size_t>(level)].roughness;
  add(attributes, "roughness", roughness ? roughness_text(*roughness) : "");
  return merged(std::move(attributes), map.attributes);
}

}  // namespace lightproof
