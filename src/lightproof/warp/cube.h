// Cube maps: directions and points on the six faces of a cube, as OpenGL, Vulkan, Direct3D and
// KTX 2.0 define them. Faces come in the order +X, -X, +Y, -Y, +Z, -Z, each with its first texel at
// the top left, in a left-handed frame with +Y up and, in front of +Z, +X on the right. Every face
// is then the picture that an eye at the centre sees: nothing is mirrored.
//
// From Lightproof's right-handed frame with z up, that frame is reached by the rotation
// (X, Y, Z) = (x, z, -y) to the right-handed frame with Y up of glTF (the one that Blender's
// exporter applies), followed by the mirror image (-X, Y, Z) that makes it left-handed:
//
//   zenith +z -> +Y      nadir -z -> -Y      +x -> -X      -x -> +X      +y -> -Z      -y -> +Z
//
// three.js looks such faces up at (-X, Y, Z) of its world, and Babylon.js places glTF scenes at
// (-X, Y, Z) of its left-handed one: in both a scene exported from Blender finds the light where it
// was, and three.js finds a latitude-longitude picture of the same map in the same place. Filament
// and the glTF Sample Viewer look up (X, Y, Z) itself, and so need the mirror image of the faces:
// the projection `cube-mirrored` of image/map_levels.h.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"

namespace lightproof {

/// In the order in which files and graphics libraries hold them.
enum class CubeFace { positive_x, negative_x, positive_y, negative_y, positive_z, negative_z };

inline constexpr std::array kCubeFaces = {CubeFace::positive_x, CubeFace::negative_x,
                                          CubeFace::positive_y, CubeFace::negative_y,
                                          CubeFace::positive_z, CubeFace::negative_z};

/// "+X".
std::string_view name_of(CubeFace face);

/// A point of a face: u from its left to its right edge, v from its upper to its lower edge, both
/// in [0,1].
struct CubePoint {
  CubeFace face;
  double u;
  double v;
};

/// The direction in the cube's own, left-handed axes (+Y up) of a direction in Lightproof's world.
inline Direction cube_axes_from_world(Direction d) { return {-d.x, d.z, -d.y}; }

/// The inverse of cube_axes_from_world().
inline Direction world_from_cube_axes(Direction c) { return {-c.x, -c.z, c.y}; }

/// What a face's right and lower edges and its middle point to, in the cube's own axes.
struct CubeFaceAxes {
  Direction right;
  Direction down;
  Direction forward;
};

inline const CubeFaceAxes& axes_of(CubeFace face) {
  static constexpr std::array<CubeFaceAxes, 6> kAxes = {{
      {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}},
      {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
      {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
      {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
      {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
      {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
  }};
  return kAxes[static_cast<std::size_t>(face)];
}

/// The unit vector, in Lightproof's world, of a point of a face. Beyond [0,1] it goes on in the
/// face's plane.
inline Direction direction_from_cube(CubePoint at) {
  const CubeFaceAxes& axes = axes_of(at.face);
  return world_from_cube_axes(glm::normalize(axes.forward + (2.0 * at.u - 1.0) * axes.right +
                                             (2.0 * at.v - 1.0) * axes.down));
}

/// The point that a direction in Lightproof's world, of any length but 0, goes through. On an edge
/// X comes before Y, and Y before Z.
inline CubePoint cube_from_direction(Direction d) {
  const Direction c = cube_axes_from_world(d);
  const Direction size = glm::abs(c);
  const int axis = size.x >= std::max(size.y, size.z) ? 0 : (size.y >= size.z ? 1 : 2);
  const CubeFace face =
      kCubeFaces[static_cast<std::size_t>(2 * axis + (std::signbit(c[axis]) ? 1 : 0))];
  const CubeFaceAxes& axes = axes_of(face);
  const auto along = [&](Direction edge) { return 0.5 + 0.5 * glm::dot(c, edge) / size[axis]; };
  return {face, along(axes.right), along(axes.down)};
}

/// d(omega) / (du dv) at a point of any face, in steradian: 4 / (1 + a^2 + b^2)^(3/2) with a and b
/// the offsets from the middle in [-1,1]. It is 4 in the middle and 4 / 3^(3/2) in the corners.
inline double solid_angle_per_face(double u, double v) {
  const double a = 2.0 * u - 1.0;
  const double b = 2.0 * v - 1.0;
  const double square = 1.0 + a * a + b * b;
  return 4.0 / (square * std::sqrt(square));
}

/// A texel of a face of size x size: column from the left, row from the top.
struct CubeTexel {
  CubeFace face;
  int column;
  int row;
  friend bool operator==(CubeTexel, CubeTexel) = default;
};

/// The unit vector, in Lightproof's world, of the texel's centre.
inline Direction direction_of(CubeTexel texel, int size) {
  return direction_from_cube({texel.face, (texel.column + 0.5) / size, (texel.row + 0.5) / size});
}

/// The texel that a direction in Lightproof's world, of any length but 0, goes through.
CubeTexel texel_at(Direction d, int size);

/// The solid angle of a texel in steradian, exact for every size: nothing cancels.
double cube_texel_solid_angle(int size, int column, int row);

/// The texel itself, or the one across the edge if its column or its row (not both: at a corner of
/// the cube three texels meet, and no fourth) lies one step outside the face. It is what a seamless
/// look-up interpolates with.
CubeTexel across_edge(CubeTexel texel, int size);

}  // namespace lightproof
