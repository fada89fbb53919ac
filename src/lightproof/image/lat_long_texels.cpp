#include "lightproof/image/lat_long_texels.h"

#include <fmt/format.h>

#include <algorithm>

#include "lightproof/core/error.h"
#include "lightproof/image/reproject.h"

namespace lightproof {
namespace {

/// A preset whose pictures have this mapping, which is none of latitude and longitude.
Preset preset_with(MappingKind kind) {
  switch (kind) {
    case MappingKind::octahedral:
      return Preset::pbrt_v4;
    case MappingKind::cube_strip:
      return Preset::cube;
    case MappingKind::node_rows:
      return Preset::openexr;
    case MappingKind::lat_long:
      break;
  }
  return Preset::z_up;
}

/// The picture, row 0 at its top, whose own texels these are.
Grid<Rgb> picture_of(const EnvironmentMap& map) {
  const auto [width, height] = map.radiance.extent();
  // The last column of nodes is the first.
  const int repeated = map.mapping.kind == MappingKind::node_rows ? 1 : 0;
  Grid<Rgb> picture({width + repeated, height});
  for (int y = 0; y < height; ++y) {
    const auto from = map.radiance.row(height - 1 - y);
    const auto to = picture.row(y);
    std::ranges::copy(from, to.begin());
    if (repeated != 0) to.back() = from.front();
  }
  return picture;
}

}  // namespace

void require_lat_long(const EnvironmentMap& map, std::string_view user) {
  if (is_plain(map.mapping)) return;
  throw InputError(fmt::format(
      "{}: its texels are {}, and {} needs those of latitude and longitude: bring it there with "
      "--resample, or with resampled_to_lat_long() of lightproof/image/lat_long_texels.h",
      map.name, describe(map.mapping), user));
}

const Grid<Rgb>& lat_long_radiance(const EnvironmentMap& map, std::string_view user) {
  require_lat_long(map, user);
  return map.radiance;
}

EnvironmentMap resampled_to_lat_long(EnvironmentMap map) {
  if (is_plain(map.mapping)) return map;
  const MappingKind kind = map.mapping.kind;
  if (kind != MappingKind::lat_long) {
    map.radiance = map_from_picture(preset_with(kind), picture_of(map));
  }
  map.mapping = {};
  map.origin.is_resampled = true;
  const char* how = kind == MappingKind::lat_long    ? "columns moved by half a texel"
                    : kind == MappingKind::node_rows ? "interpolated bilinearly between nodes"
                                                     : "the nearest texel each";
  map.notes.push_back(fmt::format("Brought to {}x{} texels of latitude and longitude: {}.",
                                  map.radiance.extent().width, map.radiance.extent().height, how));
  return map;
}

}  // namespace lightproof
