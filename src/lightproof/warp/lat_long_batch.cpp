#include "lightproof/warp/lat_long_batch.h"

#include "lightproof/core/measure.h"
#include "lightproof/warp/lat_long.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lightproof/warp/lat_long_batch.cpp"
#include <hwy/foreach_target.h>
// Highway asks for this order.
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

std::size_t convert(std::span<const double> /*s*/, std::span<const double> /*t*/,
                    const DirectionSpans& /*directions*/) {
  return 0;
}

#else

namespace hn = hwy::HWY_NAMESPACE;

/// Whole vectors from the front; returns how many points that were.
std::size_t convert(std::span<const double> s, std::span<const double> t,
                    const DirectionSpans& directions) {
  const hn::ScalableTag<double> tag;
  const auto pi = hn::Set(tag, kPi);
  const auto one = hn::Set(tag, 1.0);
  std::size_t done = 0;
  for (; done + hn::Lanes(tag) <= s.size(); done += hn::Lanes(tag)) {
    const auto along = hn::LoadU(tag, t.data() + done);
    const auto twice_s = hn::Mul(hn::Set(tag, 2.0 * kPi), hn::LoadU(tag, s.data() + done));
    const auto phi = hn::Sub(pi, twice_s);
    const auto from_pole = hn::Mul(pi, hn::Min(along, hn::Sub(one, along)));
    const auto sine = hn::Sin(tag, from_pole);
    const auto height = hn::Cos(tag, from_pole);
    const auto lower = hn::Lt(along, hn::Set(tag, 0.5));
    hn::StoreU(hn::Mul(sine, hn::Cos(tag, phi)), tag, directions.x.data() + done);
    hn::StoreU(hn::Mul(sine, hn::Sin(tag, phi)), tag, directions.y.data() + done);
    hn::StoreU(hn::IfThenElse(lower, hn::Neg(height), height), tag, directions.z.data() + done);
    hn::StoreU(hn::Mul(hn::Set(tag, 2.0 * kPi * kPi), sine), tag,
               directions.steradian.data() + done);
  }
  return done;
}

#endif

}  // namespace
}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lightproof {
namespace {

HWY_EXPORT(convert);

}  // namespace

void directions_from_squares(std::span<const double> s, std::span<const double> t,
                             const DirectionSpans& directions) {
  std::size_t i = HWY_DYNAMIC_DISPATCH(convert)(s, t, directions);
  for (; i < s.size(); ++i) {
    const Direction direction = direction_from_square({s[i], t[i]});
    directions.x[i] = direction.x;
    directions.y[i] = direction.y;
    directions.z[i] = direction.z;
    directions.steradian[i] = solid_angle_per_square(t[i]);
  }
}

}  // namespace lightproof
#endif
