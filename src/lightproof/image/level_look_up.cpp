#include "lightproof/image/level_look_up.h"

#include <algorithm>
#include <cmath>

#include "lightproof/warp/cube.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// The upper left of the four texels around a point, and how far the point is on the way to the
/// lower right one.
struct Quad {
  int column;
  int row;
  double across;
  double along;
};

/// `u` and `v` in [0,1], from the top left. The texel may lie one step outside.
Quad quad_at(double u, double v, Extent extent) {
  const double x = u * extent.width - 0.5;
  const double y = v * extent.height - 0.5;
  const double column = std::floor(x);
  const double row = std::floor(y);
  return {static_cast<int>(column), static_cast<int>(row), x - column, y - row};
}

/// `texel(column, row)` may be asked for one step outside.
template <class Texel>
Rgb interpolated(const Quad& quad, const Texel& texel) {
  const auto at = [&](int right, int below) {
    return glm::dvec3(texel(quad.column + right, quad.row + below));
  };
  return Rgb(glm::mix(glm::mix(at(0, 0), at(1, 0), quad.across),
                      glm::mix(at(0, 1), at(1, 1), quad.across), quad.along));
}

Rgb in_lat_long(const Grid<Rgb>& picture, Direction direction) {
  const Extent extent = picture.extent();
  const SquarePoint at = square_from_direction(direction);
  return interpolated(quad_at(at.s, 1.0 - at.t, extent), [&](int column, int row) {
    return picture((column + extent.width) % extent.width, std::clamp(row, 0, extent.height - 1));
  });
}

Rgb value_of(const MapLevel& level, CubeTexel texel) {
  return level.faces[static_cast<std::size_t>(texel.face)](texel.column, texel.row);
}

/// The value of a texel of the face, or of one a step outside of it.
Rgb seamless(const MapLevel& level, CubeTexel texel, int size) {
  const CubeTexel inside = {texel.face, std::clamp(texel.column, 0, size - 1),
                            std::clamp(texel.row, 0, size - 1)};
  if (inside.column == texel.column || inside.row == texel.row) {
    return value_of(level, across_edge(texel, size));
  }
  const CubeTexel beside = across_edge({texel.face, texel.column, inside.row}, size);
  const CubeTexel below = across_edge({texel.face, inside.column, texel.row}, size);
  return (value_of(level, inside) + value_of(level, beside) + value_of(level, below)) / 3.0F;
}

Rgb in_cube(const MapLevel& level, Direction direction) {
  const Extent extent = level.faces.front().extent();
  const CubePoint at = cube_from_direction(direction);
  return interpolated(quad_at(at.u, at.v, extent), [&](int column, int row) {
    return seamless(level, {at.face, column, row}, extent.width);
  });
}

}  // namespace

Rgb look_up_bilinear(const MapLevels& map, int level, Direction direction) {
  const MapLevel& texels = map.levels[static_cast<std::size_t>(level)];
  if (!is_cube(map.projection)) return in_lat_long(texels.faces.front(), direction);
  return in_cube(texels, map.projection == Projection::cube ? direction : mirrored(direction));
}

Rgb look_up_trilinear(const MapLevels& map, double lod, Direction direction) {
  const int last = static_cast<int>(map.levels.size()) - 1;
  const double level = std::clamp(lod, 0.0, static_cast<double>(last));
  const int finer = static_cast<int>(level);
  const auto weight = static_cast<float>(level - finer);
  const Rgb fine = look_up_bilinear(map, finer, direction);
  if (weight == 0.0F) return fine;
  return glm::mix(fine, look_up_bilinear(map, finer + 1, direction), weight);
}

}  // namespace lightproof
