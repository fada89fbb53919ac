// A map that an engine loads: a pyramid of levels, each of them one latitude-longitude picture or
// the six faces of a cube. The value that the writers of files take.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/image/attribute.h"
#include "lightproof/image/chromaticities.h"

namespace lightproof {

enum class Projection {
  lat_long,       ///< the convention `z-up` of warp/preset.h
  cube,           ///< the faces of warp/cube.h: what an eye in the centre sees
  mirrored_cube,  ///< their mirror image, for engines that look up (X, Y, Z) = (x, z, -y)
};

struct ProjectionInfo {
  Projection projection;
  std::string_view name;         ///< as on the command line: `latlong`
  std::string_view description;  ///< faces and axes, one line; it stands in the files' attributes
  int faces;
};

std::span<const ProjectionInfo> projections();
const ProjectionInfo& info(Projection projection);
/// None if there is no projection of this name.
std::optional<Projection> projection_by_name(std::string_view name);
inline bool is_cube(Projection projection) { return projection != Projection::lat_long; }

struct MapLevel {
  /// The roughness of the surfaces that the level is filtered for, in [0,1]; none where it means
  /// nothing, as in an irradiance map.
  std::optional<double> roughness = std::nullopt;
  /// One picture, or six in the order of kCubeFaces. Row 0 is at the top, as in all pictures and
  /// unlike in an EnvironmentMap.
  std::vector<Grid<Rgb>> faces;

  static auto fields(auto& level) { return std::tie(level.roughness, level.faces); }
};

/// A level of one latitude-longitude picture, from a map whose row 0 lies at t = 0.
MapLevel lat_long_level(const Grid<Rgb>& map, std::optional<double> roughness = std::nullopt);

/// Level i measures level_extent() of level 0; faces of a cube are square. All values are linear.
struct MapLevels {
  Projection projection = Projection::lat_long;
  std::vector<MapLevel> levels;  ///< at least one
  /// The chromaticities of red, green and blue; none means Rec. 709.
  std::optional<Chromaticities> chromaticities = std::nullopt;
  /// How the map was made. Writers add what the levels themselves say.
  Attributes attributes = {};

  /// The size of one face of level 0.
  Extent extent() const { return levels.front().faces.front().extent(); }
};

/// Whether sizes and numbers of faces are as MapLevels says.
bool is_pyramid(const MapLevels& map);

/// Width and height are halved and rounded down from level to level, down to 1: what graphics
/// libraries, KTX and OpenEXR call mipmaps.
Extent level_extent(Extent base, int level);

/// How many levels there are down to 1 x 1.
int most_levels(Extent base);

/// Throws InputError unless a map may have this size: 1 x 1 to kLargestPicture, square for the
/// faces of a cube.
void check_map_size(Projection projection, Extent extent);

/// Throws InputError unless a map of this size may have so many levels: 1 to most_levels().
void check_level_count(Extent base, int levels);

/// A texel of a level: the number of its face, column from the left, row from the top.
struct LevelTexel {
  int face;
  int column;
  int row;
  friend bool operator==(LevelTexel, LevelTexel) = default;
};

/// The world direction at which Projection::cube holds what Projection::mirrored_cube holds at `d`:
/// x with the other sign, which changes (-x, z, -y) into (x, z, -y).
inline Direction mirrored(Direction d) { return {-d.x, d.y, d.z}; }

/// World direction of the texel's centre, z up, in a level of this size.
Direction direction_of(Projection projection, Extent extent, LevelTexel texel);

/// The texel that a world direction, z up, goes through.
LevelTexel texel_at(Projection projection, Extent extent, Direction direction);

/// The solid angle of a texel in steradian.
double solid_angle_of(Projection projection, Extent extent, LevelTexel texel);

/// What a file with all levels says of them, before the map's own attributes: projection, sizes,
/// roughness of each level.
Attributes attributes_of(const MapLevels& map);

/// What a file with one face of one level says of it: projection, sizes, the roughness of the
/// level.
Attributes attributes_of(const MapLevels& map, int level, int face);

}  // namespace lightproof
