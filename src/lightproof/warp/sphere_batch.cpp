#include "lightproof/warp/sphere_batch.h"

#include <cmath>

#include "lightproof/core/measure.h"
#include "lightproof/warp/lat_long.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lightproof/warp/sphere_batch.cpp"
#include <hwy/foreach_target.h>
// Highway asks for this order.
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "lightproof/warp/sin_cos-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

std::size_t convert(std::span<const double> /*s*/, std::span<const double> /*u*/,
                    const DirectionSpans& /*directions*/) {
  return 0;
}

std::size_t direct(std::span<const double> /*s*/, std::span<const double> /*t*/,
                   const PositionedDirectionSpans& /*directions*/) {
  return 0;
}

#else

namespace hn = hwy::HWY_NAMESPACE;

/// Converts whole vectors from the front; returns how many points that were.
std::size_t convert(std::span<const double> s, std::span<const double> u,
                    const DirectionSpans& directions) {
  const hn::ScalableTag<double> d;
  const auto one = hn::Set(d, 1.0);
  const auto two = hn::Set(d, 2.0);
  std::size_t done = 0;
  for (; done + hn::Lanes(d) <= s.size(); done += hn::Lanes(d)) {
    const auto share = hn::LoadU(d, u.data() + done);
    const auto azimuth = sin_cos_of_turns(d, hn::LoadU(d, s.data() + done));
    const auto root = hn::Sqrt(hn::Mul(share, hn::Sub(one, share)));
    const auto sine = hn::Mul(two, root);
    const auto z = hn::Sub(hn::Mul(two, share), one);
    hn::StoreU(hn::Neg(hn::Mul(sine, azimuth.cos)), d, directions.x.data() + done);
    hn::StoreU(hn::Mul(sine, azimuth.sin), d, directions.y.data() + done);
    hn::StoreU(z, d, directions.z.data() + done);
    const auto angle = hn::Acos(d, hn::Neg(z));
    hn::StoreU(hn::Mul(angle, hn::Set(d, 1.0 / kPi)), d, directions.t.data() + done);
  }
  return done;
}

/// Converts whole vectors from the front; returns how many places that were.
std::size_t direct(std::span<const double> s, std::span<const double> t,
                   const PositionedDirectionSpans& directions) {
  const hn::ScalableTag<double> d;
  const auto one = hn::Set(d, 1.0);
  const auto half = hn::Set(d, 0.5);
  std::size_t done = 0;
  for (; done + hn::Lanes(d) <= s.size(); done += hn::Lanes(d)) {
    const auto along = hn::LoadU(d, t.data() + done);
    const auto from_pole = hn::Min(along, hn::Sub(one, along));
    const auto polar = sin_cos_of_turns(d, hn::Mul(half, from_pole));
    const auto azimuth = sin_cos_of_turns(d, hn::LoadU(d, s.data() + done));
    const auto z = hn::IfThenElse(hn::Lt(along, half), hn::Neg(polar.cos), polar.cos);
    hn::StoreU(hn::Neg(hn::Mul(polar.sin, azimuth.cos)), d, directions.x.data() + done);
    hn::StoreU(hn::Mul(polar.sin, azimuth.sin), d, directions.y.data() + done);
    hn::StoreU(z, d, directions.z.data() + done);
    hn::StoreU(polar.sin, d, directions.sine.data() + done);
  }
  return done;
}

#endif

/// A plain loop, which the compiler makes vectors of.
void find_positions(const double* x, const double* y, const double* z,
                    const PositionSpans& positions) {
  double* s = positions.s.data();
  double* t = positions.t.data();
  for (std::size_t i = 0; i < positions.s.size(); ++i) {
    const SquarePoint at = approximate_square_from_direction({x[i], y[i], z[i]});
    s[i] = at.s;
    t[i] = at.t;
  }
}

}  // namespace
}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lightproof {
namespace {

HWY_EXPORT(convert);
HWY_EXPORT(direct);
HWY_EXPORT(find_positions);

}  // namespace

std::size_t uniform_directions(std::span<const double> s, std::span<const double> u,
                               const DirectionSpans& directions) {
  const std::size_t by_vectors = HWY_DYNAMIC_DISPATCH(convert)(s, u, directions);
  for (std::size_t i = by_vectors; i < s.size(); ++i) {
    const double sine = 2.0 * std::sqrt(u[i] * (1.0 - u[i]));
    const double z = 2.0 * u[i] - 1.0;
    directions.x[i] = -sine * std::cos(2.0 * kPi * s[i]);
    directions.y[i] = sine * std::sin(2.0 * kPi * s[i]);
    directions.z[i] = z;
    directions.t[i] = std::acos(-z) / kPi;
  }
  return by_vectors;
}

std::size_t directions_of_positions(std::span<const double> s, std::span<const double> t,
                                    const PositionedDirectionSpans& directions) {
  const std::size_t by_vectors = HWY_DYNAMIC_DISPATCH(direct)(s, t, directions);
  for (std::size_t i = by_vectors; i < s.size(); ++i) {
    const Direction direction = direction_from_square({s[i], t[i]});
    directions.x[i] = direction.x;
    directions.y[i] = direction.y;
    directions.z[i] = direction.z;
    directions.sine[i] = sin_theta(t[i]);
  }
  return by_vectors;
}

void approximate_positions(std::span<const double> x, std::span<const double> y,
                           std::span<const double> z, const PositionSpans& positions) {
  HWY_DYNAMIC_DISPATCH(find_positions)(x.data(), y.data(), z.data(), positions);
}

}  // namespace lightproof
#endif
