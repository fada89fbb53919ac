// The mappings as their renderers print them: u from the left, v from the top.
// Slow and separate from warp/preset.cpp, which they check.
#pragma once

#include <cmath>

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"
#include "lightproof/warp/preset.h"

namespace lightproof::test {

struct PublishedPoint {
  double u;
  double v;
};

inline double fraction(double x) { return x - std::floor(x); }

/// Clarberg's fold, written with the angle of the whole turn.
inline PublishedPoint published_octahedral(Direction d) {
  const double radius = std::sqrt(std::max(0.0, 1.0 - std::abs(d.z)));
  const double b = radius * std::atan2(std::abs(d.y), std::abs(d.x)) * 2.0 / kPi;
  const double a = radius - b;
  const double p = d.z < 0 ? 1.0 - b : a;
  const double q = d.z < 0 ? 1.0 - a : b;
  return {(d.x < 0 ? 1.0 - p : 1.0 + p) / 2.0, (d.y < 0 ? 1.0 - q : 1.0 + q) / 2.0};
}

inline PublishedPoint published_mapping(Preset preset, Direction d) {
  const double y_up_x = d.y;  // the axes of the y-up presets
  const double y_up_y = d.z;
  const double y_up_z = d.x;
  const double v = std::acos(d.z) / kPi;
  switch (preset) {
    case Preset::z_up:
      return {0.5 - std::atan2(d.y, d.x) / (2.0 * kPi), v};
    case Preset::z_up_half_turn:
      return {1.0 - fraction(std::atan2(d.y, d.x) / (2.0 * kPi)), v};
    case Preset::openexr:
    case Preset::exr_area:
      return {(kPi - std::atan2(y_up_x, y_up_z)) / (2.0 * kPi),
              (kPi / 2.0 - std::asin(y_up_y)) / kPi};
    case Preset::pbrt_v3:
      return {fraction(std::atan2(d.y, d.x) / (2.0 * kPi)), v};
    case Preset::pbrt_v4:
      return published_octahedral(d);
    case Preset::mitsuba:
      return {fraction(std::atan2(y_up_x, -y_up_z) / (2.0 * kPi)), std::acos(y_up_y) / kPi};
    case Preset::cube: {
      // Table 8.19 of the OpenGL 4.6 specification, of (X, Y, Z) = (-x, z, -y), faces in a row.
      const double x = -d.x;
      const double y = d.z;
      const double z = -d.y;
      const double ax = std::abs(x);
      const double ay = std::abs(y);
      const double az = std::abs(z);
      const auto point = [](int face, double sc, double tc, double ma) {
        return PublishedPoint{(face + 0.5 * (sc / ma + 1.0)) / 6.0, 0.5 * (tc / ma + 1.0)};
      };
      if (ax >= ay && ax >= az) return x > 0 ? point(0, -z, -y, ax) : point(1, z, -y, ax);
      if (ay >= az) return y > 0 ? point(2, x, z, ay) : point(3, x, -z, ay);
      return z > 0 ? point(4, x, -y, az) : point(5, -x, -y, az);
    }
  }
  return {};
}

}  // namespace lightproof::test
