#include "lightproof/warp/mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lightproof/warp/cube.h"
#include "lightproof/warp/lat_long.h"
#include "lightproof/warp/octahedral.h"

namespace lightproof {
namespace {

constexpr std::array kMappings = {
    MappingInfo{MappingKind::lat_long, "lat-long",
                "latitude-longitude: rows of equal angle, columns of equal azimuth"},
    MappingInfo{MappingKind::node_rows, "lat-long nodes",
                "latitude-longitude around nodes: the rows of the poles are half as high"},
    MappingInfo{MappingKind::octahedral, "octahedral",
                "equal-area octahedral square of pbrt-v4: all texels have one solid angle"},
    MappingInfo{MappingKind::cube_strip, "cube",
                "faces of a cube side by side: +X, -X, +Y, -Y, +Z, -Z, each as seen from inside"},
};

constexpr int kFaces = 6;
/// A point stays so far inside its face that (face + u) / 6 does not round to the next one.
constexpr double kLastOfFace = 1.0 - 0x1p-40;

/// s modulo 1, in [0, 1) for s in [-1, 2).
double wrapped(double s) {
  const double fraction = s - std::floor(s);
  return fraction < 1.0 ? fraction : 0.0;
}

/// The t of Lightproof's frame at a t of rows around nodes.
double height_at(const Mapping& mapping, double t) {
  const double row = t * mapping.rows;
  const double steps = mapping.rows - 1.0;
  if (row < 1.0) return 0.5 * row / steps;
  if (row > steps) return 1.0 - 0.5 * (mapping.rows - row) / steps;
  return (row - 0.5) / steps;
}

/// The inverse of height_at().
double t_of_height(const Mapping& mapping, double height) {
  const double steps = mapping.rows - 1.0;
  const double from_pole = std::min(height, 1.0 - height) * steps;
  const double rows = from_pole < 0.5 ? 2.0 * from_pole : from_pole + 0.5;
  return (height < 0.5 ? rows : mapping.rows - rows) / mapping.rows;
}

/// d(height) / dt.
double height_per_t(const Mapping& mapping, double t) {
  const double row = t * mapping.rows;
  const double steps = mapping.rows - 1.0;
  return mapping.rows / steps * (row < 1.0 || row > steps ? 0.5 : 1.0);
}

double lat_long_height(const Mapping& mapping, double t) {
  return mapping.kind == MappingKind::node_rows ? height_at(mapping, t) : t;
}

CubePoint cube_point(SquarePoint at) {
  const double scaled = at.s * kFaces;
  // In this order: converted to an integer before, what is not a number would be undefined.
  const int face = static_cast<int>(std::min(std::max(0.0, scaled), kFaces - 1.0));
  return {kCubeFaces[static_cast<std::size_t>(face)], scaled - face, 1.0 - at.t};
}

/// Between two heights, per unit of azimuth: a product, so that nothing cancels at a pole.
double band(double low, double high) {
  return 2.0 * sin_theta(0.5 * (low + high)) * std::sin(0.5 * kPi * (high - low));
}

}  // namespace

std::span<const MappingInfo> mappings() { return kMappings; }

const MappingInfo& info(MappingKind kind) { return kMappings[static_cast<std::size_t>(kind)]; }

std::string describe(const Mapping& mapping) {
  const std::string name(info(mapping.kind).name);
  if (mapping.kind != MappingKind::lat_long || mapping.shift == 0.0) return name;
  return fmt::format("{}, shifted by {:.3g} of its width", name, mapping.shift);
}

Mapping node_mapping(Extent texels) {
  return {MappingKind::node_rows, -0.5 / texels.width, texels.height};
}

std::string size_fault(const Mapping& mapping, Extent texels) {
  switch (mapping.kind) {
    case MappingKind::octahedral:
      return texels.width == texels.height ? "" : "an octahedral map is square";
    case MappingKind::cube_strip:
      return texels.width == kFaces * texels.height
                 ? ""
                 : "a strip of cube faces is six times as wide as high";
    case MappingKind::node_rows:
      return texels.height >= 2 && texels.height == mapping.rows
                 ? ""
                 : "a map around nodes has at least two rows";
    case MappingKind::lat_long:
      break;
  }
  return "";
}

Direction direction_at(const Mapping& mapping, SquarePoint at) {
  switch (mapping.kind) {
    case MappingKind::octahedral:
      return octahedral_from_square({at.s, 1.0 - at.t});
    case MappingKind::cube_strip:
      return direction_from_cube(cube_point(at));
    case MappingKind::lat_long:
    case MappingKind::node_rows:
      break;
  }
  return direction_from_square({at.s + mapping.shift, lat_long_height(mapping, at.t)});
}

SquarePoint square_point_of(const Mapping& mapping, Direction direction) {
  switch (mapping.kind) {
    case MappingKind::octahedral: {
      const SquarePoint at = square_from_octahedral(direction);
      return {std::min(at.s, 1.0 - 0x1p-53), 1.0 - at.t};
    }
    case MappingKind::cube_strip: {
      const CubePoint at = cube_from_direction(direction);
      const double u = std::clamp(at.u, 0x1p-40, kLastOfFace);
      return {(static_cast<double>(at.face) + u) / kFaces, std::clamp(1.0 - at.v, 0.0, 1.0)};
    }
    case MappingKind::lat_long:
    case MappingKind::node_rows:
      break;
  }
  const SquarePoint at = square_from_direction(direction);
  return {mapping.shift == 0.0 ? at.s : wrapped(at.s - mapping.shift),
          mapping.kind == MappingKind::node_rows ? t_of_height(mapping, at.t) : at.t};
}

double solid_angle_per_square(const Mapping& mapping, SquarePoint at) {
  switch (mapping.kind) {
    case MappingKind::octahedral:
      return kSphere;
    case MappingKind::cube_strip: {
      const CubePoint on_face = cube_point(at);
      return kFaces * solid_angle_per_face(on_face.u, on_face.v);
    }
    case MappingKind::node_rows:
      return solid_angle_per_square(height_at(mapping, at.t)) * height_per_t(mapping, at.t);
    case MappingKind::lat_long:
      break;
  }
  return solid_angle_per_square(at.t);
}

TurnEffect effect_of_turn(const Mapping& mapping, SquarePoint at) {
  switch (mapping.kind) {
    case MappingKind::octahedral:
      // In an octant, with r = sqrt(2) sin(theta/2) and the azimuth's share f of a quarter turn,
      // 2s - 1 is r (1 - f) and 2t - 1 is r f. With c = cos(theta/2), at least sqrt(1/2) there,
      // their squared gradients are at most c^2 / 2 along the meridian and (2/pi)^2 / (2 c^2) along
      // the parallel, the sum of which is largest at the pole.
      return {0.5 * std::sqrt(0.5 + 2.0 / (kPi * kPi)), 0.5 * std::sqrt(0.5 + 2.0 / (kPi * kPi)),
              0.0};
    case MappingKind::cube_strip: {
      // With a = 2u - 1, b = 2v - 1 and the direction (a, b, 1) / q on the face, the gradient of a
      // over the sphere is q sqrt(1 + a^2) long, and d(omega) goes with q^-3 = cos^3 of the angle
      // to the face's middle.
      const CubePoint on_face = cube_point(at);
      const double a = 2.0 * on_face.u - 1.0;
      const double b = 2.0 * on_face.v - 1.0;
      const double q = std::sqrt(1.0 + a * a + b * b);
      return {0.5 * q * std::sqrt(1.0 + a * a) / kFaces, 0.5 * q * std::sqrt(1.0 + b * b),
              3.0 * std::hypot(a, b)};
    }
    case MappingKind::lat_long:
    case MappingKind::node_rows:
      break;
  }
  const double sine = sin_theta(lat_long_height(mapping, at.t));
  const double rows = mapping.kind == MappingKind::node_rows ? height_per_t(mapping, at.t) : 1.0;
  return {0.5 / (kPi * sine), 1.0 / (kPi * rows), 1.0 / sine};
}

double texel_solid_angle(const Mapping& mapping, Extent extent, int x, int y) {
  switch (mapping.kind) {
    case MappingKind::octahedral:
      return kSphere / static_cast<double>(extent.count());
    case MappingKind::cube_strip:
      return cube_texel_solid_angle(extent.height, x % extent.height, extent.height - 1 - y);
    case MappingKind::node_rows: {
      const SquareCell cell = texel_cell(extent, x, y);
      return 2.0 * kPi / extent.width *
             band(height_at(mapping, cell.bottom), height_at(mapping, cell.top));
    }
    case MappingKind::lat_long:
      break;
  }
  return texel_solid_angle(extent, y);
}

}  // namespace lightproof
