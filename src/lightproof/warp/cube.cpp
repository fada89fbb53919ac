#include "lightproof/warp/cube.h"

#include <cassert>

namespace lightproof {
namespace {

/// Solid angle of the triangle of three vectors, given their triple product (van Oosterom and
/// Strackee 1983, "The Solid Angle of a Plane Triangle").
double triangle_solid_angle(double triple_product, Direction a, Direction b, Direction c) {
  const double la = glm::length(a);
  const double lb = glm::length(b);
  const double lc = glm::length(c);
  return 2.0 * std::atan2(triple_product, la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la +
                                              glm::dot(c, a) * lb);
}

int texel_of(double coordinate, int size) {
  // In this order: converted to an integer before, what is not a number would be undefined.
  return static_cast<int>(std::min(std::max(0.0, coordinate * size), size - 1.0));
}

}  // namespace

std::string_view name_of(CubeFace face) {
  static constexpr std::array<std::string_view, 6> kNames = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
  return kNames[static_cast<std::size_t>(face)];
}

CubeTexel texel_at(Direction d, int size) {
  const CubePoint at = cube_from_direction(d);
  return {at.face, texel_of(at.u, size), texel_of(at.v, size)};
}

double cube_texel_solid_angle(int size, int column, int row) {
  const auto corner = [&](int x, int y) {
    return Direction(2.0 * x / size - 1.0, 2.0 * y / size - 1.0, 1.0);
  };
  const Direction a = corner(column, row);
  const Direction b = corner(column + 1, row);
  const Direction c = corner(column + 1, row + 1);
  const Direction d = corner(column, row + 1);
  // The triple product of three corners at distance 1 is the area of their rectangle; as a
  // determinant it would lose most of its digits.
  const double area = 4.0 / (double{1.0} * size * size);
  return triangle_solid_angle(area, a, b, c) + triangle_solid_angle(area, a, c, d);
}

CubeTexel across_edge(CubeTexel texel, int size) {
  const auto inside = [&](int index) { return index >= 0 && index < size; };
  if (inside(texel.column) && inside(texel.row)) return texel;
  assert(inside(texel.column) || inside(texel.row));
  // Folded over the edge, half a texel beyond it becomes half a texel below the face's plane.
  const CubeFaceAxes& axes = axes_of(texel.face);
  const double half = 1.0 / size;
  const auto offset = [&](int index) {
    return std::clamp((2.0 * index + 1.0) / size - 1.0, -1.0, 1.0);
  };
  const Direction folded = (1.0 - half) * axes.forward + offset(texel.column) * axes.right +
                           offset(texel.row) * axes.down;
  return texel_at(world_from_cube_axes(folded), size);
}

}  // namespace lightproof
