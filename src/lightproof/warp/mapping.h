// How the texels of a map lie on the sphere: the square of a map's texels, and the directions of
// its points. A map keeps the mapping of its file, so that nothing has to be resampled.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"

namespace lightproof {

/// The families of mappings.
enum class MappingKind {
  lat_long,    ///< rows of equal angle between parallels, columns of equal azimuth
  node_rows,   ///< as lat_long, but the rows of the poles are half as high as the others
  octahedral,  ///< the equal-area octahedral map of pbrt-v4
  cube_strip,  ///< six faces of a cube side by side
};

/// A mapping between points of the square, s from the left and t from the bottom of the picture,
/// and directions. Which of its functions mean what is said there holds for all of them.
struct Mapping {
  MappingKind kind = MappingKind::lat_long;
  /// lat_long and node_rows: s of Lightproof's own frame (s = 1/2 - phi/2pi) less the s of the
  /// square, modulo 1. It is not 0 where the columns of a file straddle those of that frame.
  double shift = 0.0;
  /// node_rows: rows of texels, whose heights depend on it; at least 2.
  int rows = 0;

  friend bool operator==(const Mapping&, const Mapping&) = default;
};

/// What is known of a kind of mapping.
struct MappingInfo {
  MappingKind kind;
  std::string_view name;         ///< "octahedral"
  std::string_view description;  ///< which texel lies where, one line
};

/// All kinds of mappings, in the order of their enumeration.
std::span<const MappingInfo> mappings();
/// What is known of a kind of mapping.
const MappingInfo& info(MappingKind kind);
/// "octahedral", or "lat-long, shifted by 0.01 of its width".
std::string describe(const Mapping& mapping);

/// The mapping of Lightproof's own frame, that of warp/lat_long.h.
constexpr bool is_plain(const Mapping& mapping) { return mapping == Mapping{}; }
/// Whether equal areas of the square are equal solid angles. Area and solid angle are then one
/// measure.
constexpr bool is_equal_area(const Mapping& mapping) {
  return mapping.kind == MappingKind::octahedral;
}
/// Whether every row of texels lies between two parallels, so that its texels have equal solid
/// angles, and the marginal over t is one over theta.
constexpr bool rows_are_parallels(const Mapping& mapping) {
  return mapping.kind == MappingKind::lat_long || mapping.kind == MappingKind::node_rows;
}

/// The mapping of a picture whose columns and rows are nodes, given the number of texels: those of
/// one node each, where the first and the last column of nodes are one.
Mapping node_mapping(Extent texels);

/// Empty if a map of this mapping can have so many texels; else what it needs.
std::string size_fault(const Mapping& mapping, Extent texels);

/// The direction, a unit vector with z up, of a point of [0,1]^2.
Direction direction_at(const Mapping& mapping, SquarePoint at);

/// The point of [0,1)x[0,1] of a unit vector. On a cube it lies inside its face, off by up to 2^-40
/// of its width.
SquarePoint square_point_of(const Mapping& mapping, Direction direction);

/// d(omega) / (ds dt) at a point of the square, in steradian. At a pole of a latitude-longitude
/// mapping it is 0.
double solid_angle_per_square(const Mapping& mapping, SquarePoint at);

/// What a small turn of a direction does, per radian and at most: how far its point moves along
/// either side of the square, and by how much, relative, d(omega) / (ds dt) changes there. A point
/// that leaves a face of a cube, a fold of an octahedron or the square is taken to go on behind the
/// edge. Infinite at the poles of latitude and longitude.
struct TurnEffect {
  double s;
  double t;
  double jacobian;
};
TurnEffect effect_of_turn(const Mapping& mapping, SquarePoint at);

/// Solid angle, in steradian, of texel (x, y) of a map of this extent, counted from the lower left,
/// to a few roundings. Texels have a closed form in every mapping.
double texel_solid_angle(const Mapping& mapping, Extent extent, int x, int y);

/// Converts a density over the square of a mapping to one over directions. Infinite where the
/// square has no solid angle.
inline PerSteradian to_solid_angle(const Mapping& mapping, PerSquare p, SquarePoint at) {
  return {p.value / solid_angle_per_square(mapping, at)};
}

/// The cell of the square that texel (x, y) is.
struct SquareCell {
  double left;
  double right;
  double bottom;
  double top;

  SquarePoint centre() const { return {0.5 * (left + right), 0.5 * (bottom + top)}; }
  double area() const { return (right - left) * (top - bottom); }
};
inline SquareCell texel_cell(Extent extent, int x, int y) {
  return {static_cast<double>(x) / extent.width, (x + 1.0) / extent.width,
          static_cast<double>(y) / extent.height, (y + 1.0) / extent.height};
}

}  // namespace lightproof
