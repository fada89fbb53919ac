// The clamped cosine (n·w)+ integrated over cells of a latitude-longitude map, in closed form, also
// where the normal's horizon crosses them.
//
// Coordinates are relative to the normal n: theta from that pole of the map on whose side n lies,
// so that n is at most a quarter turn from it; azimuth from the meridian of n. Over a sector of
// azimuths 0 to phi that ends at the parallel theta,
//
//   F(phi, theta) = ∫∫ (n·w)+ sin(theta) d(theta) d(phi),
//
// there are two cases. Up to the azimuth at which the horizon crosses the parallel all is visible,
// and the integral of n·w itself is elementary. Beyond it the horizon cuts the sector short, and by
// Stokes' theorem the vector ∫ w d(omega) of what is left is half the line integral of w × dw along
// its edge: the horizon adds its length, the meridian at phi an angle, and neither depends on
// theta. A cell is the second difference of F, so tables for parallels and for meridians suffice;
// nothing is subdivided, and the error is that of rounding, some 1e-16 steradian for a cell.
#pragma once

#include <cmath>

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"

namespace lightproof {

/// ∫ sin^2 from 0 to `theta` in radians.
inline double integral_of_sine_squared(double theta) {
  return 0.5 * theta - 0.25 * std::sin(2.0 * theta);
}

/// ∫ sin cos from 0 to `theta` in radians.
inline double integral_of_sine_cosine(double theta) {
  const double sine = std::sin(theta);
  return 0.5 * sine * sine;
}

/// A normal by its angle to the nearer pole of the map; the cosine is not negative.
struct NormalTilt {
  double sine;
  double cosine;
};

inline NormalTilt tilt_of(Direction normal) {
  return {std::hypot(normal.x, normal.y), std::abs(normal.z)};
}

/// ∫ (n·w)+ over all that is visible between the normal's meridian and an azimuth in [0, pi] of
/// this sine and cosine: half of the horizon's length there, and of the angle along the other
/// meridian.
inline double visible_sector(NormalTilt normal, double sine, double cosine) {
  const double along_horizon = std::atan2(sine * normal.cosine, cosine);
  const double horizon = std::atan2(normal.cosine, -normal.sine * cosine);
  return 0.5 * (along_horizon + normal.sine * sine * horizon);
}

/// A circle of latitude as one normal sees it.
struct Parallel {
  Parallel(NormalTilt normal, double theta)
      : horizon(azimuth_of_horizon(normal, theta)),
        sine_squared(integral_of_sine_squared(theta)),
        sine_cosine(integral_of_sine_cosine(theta)),
        beyond(integral_to_horizon(normal) -
               visible_sector(normal, std::sin(horizon), std::cos(horizon))) {}

  double horizon;       ///< azimuth in [0, pi] up to which it is visible
  double sine_squared;  ///< ∫ sin^2 from the pole to here
  double sine_cosine;   ///< ∫ sin cos
  double beyond;        ///< F(phi, theta) less the visible sector, for phi >= horizon

 private:
  static double azimuth_of_horizon(NormalTilt normal, double theta) {
    const double height = -normal.cosine * std::cos(theta);
    const double radius = normal.sine * std::sin(theta);
    if (height <= -radius) return kPi;
    return height >= radius ? 0.0 : std::acos(height / radius);
  }
  double integral_to_horizon(NormalTilt normal) const {
    return normal.sine * std::sin(horizon) * sine_squared + normal.cosine * horizon * sine_cosine;
  }
};

/// A half circle of longitude as one normal sees it.
struct Meridian {
  /// At any azimuth, in radians from the normal's own meridian.
  Meridian(NormalTilt normal, double phi)
      : turns(std::round(phi / (2.0 * kPi))),
        azimuth(phi - turns * 2.0 * kPi),
        sine(std::sin(azimuth)),
        sector(std::copysign(visible_sector(normal, std::abs(sine), std::cos(azimuth)), azimuth)) {}

  double turns;    ///< whole ones
  double azimuth;  ///< the rest, in [-pi, pi]
  double sine;     ///< of the azimuth
  double sector;   ///< the visible one, odd in the azimuth
};

/// The band between two circles of latitude, the `inner` one nearer to the pole, as one normal sees
/// it.
class CosineBand {
 public:
  CosineBand(NormalTilt normal, const Parallel& inner, const Parallel& outer)
      : sine_(normal.sine * (outer.sine_squared - inner.sine_squared)),
        cosine_(normal.cosine * (outer.sine_cosine - inner.sine_cosine)),
        inner_sine_(normal.sine * inner.sine_squared),
        inner_cosine_(normal.cosine * inner.sine_cosine),
        outer_beyond_(outer.beyond),
        hidden_(outer.beyond - inner.beyond),
        visible_until_(outer.horizon),
        hidden_from_(inner.horizon),
        half_turn_(visible_until_ < kPi ? hidden_ : kPi * cosine_) {}

  /// All of it is visible up to this azimuth in [0, pi] …
  double visible_until() const { return visible_until_; }
  /// … and nothing from this one on.
  double hidden_from() const { return hidden_from_; }

  /// ∫ (n·w)+ d(omega) over the band, from the normal's meridian to this one. What is hidden adds
  /// exactly 0.
  double operator()(const Meridian& to) const { return within(to) + 2.0 * to.turns * half_turn_; }

 private:
  /// Odd in the azimuth.
  double within(const Meridian& to) const {
    const double azimuth = std::abs(to.azimuth);
    if (azimuth <= visible_until_) return sine_ * to.sine + cosine_ * to.azimuth;
    const double side = std::copysign(1.0, to.azimuth);
    if (azimuth >= hidden_from_) return side * hidden_;
    return side * outer_beyond_ + to.sector - (inner_sine_ * to.sine + inner_cosine_ * to.azimuth);
  }

  double sine_;
  double cosine_;
  double inner_sine_;
  double inner_cosine_;
  double outer_beyond_;
  double hidden_;
  double visible_until_;
  double hidden_from_;
  double half_turn_;  ///< ∫ up to the azimuth pi
};

}  // namespace lightproof
