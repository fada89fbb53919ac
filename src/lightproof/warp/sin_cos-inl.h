// Sine and cosine together, of an angle in turns, for vectors of doubles.
//
// Included by sources of Highway's foreach_target only, once for each kind of vector: hence the
// guard, which is Highway's.
#if defined(LIGHTPROOF_WARP_SIN_COS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_WARP_SIN_COS_INL_H
#undef LIGHTPROOF_WARP_SIN_COS_INL_H
#else
#define LIGHTPROOF_WARP_SIN_COS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "lightproof/core/measure.h"
#include "lightproof/warp/sin_cos.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

template <class D>
struct SinCos {
  hwy::HWY_NAMESPACE::Vec<D> sin;
  hwy::HWY_NAMESPACE::Vec<D> cos;
};

/// Sine and cosine of 2 pi x, x in [0, 1], with errors of some 2^-53; near the sine's zeros its
/// error is so relative to it.
template <class D>
HWY_INLINE SinCos<D> sin_cos_of_turns(D d, hwy::HWY_NAMESPACE::Vec<D> x) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<D> whole;
  const auto quarters = hn::Mul(x, hn::Set(d, 4.0));
  const auto nearest = hn::Round(quarters);
  const auto angle = hn::Mul(hn::Sub(quarters, nearest), hn::Set(d, 0.5 * kPi));
  const auto square = hn::Mul(angle, angle);
  auto sine = hn::Set(d, kSineTerms.back());
  for (std::size_t k = kSineTerms.size() - 1; k-- > 0;) {
    sine = hn::MulAdd(sine, square, hn::Set(d, kSineTerms[k]));
  }
  sine = hn::Mul(sine, angle);
  auto cosine = hn::Set(d, kCosineTerms.back());
  for (std::size_t k = kCosineTerms.size() - 1; k-- > 0;) {
    cosine = hn::MulAdd(cosine, square, hn::Set(d, kCosineTerms[k]));
  }
  // From quarter to quarter the two change places, and one of them its sign.
  const auto quarter = hn::ConvertTo(whole, nearest);
  const auto one = hn::Set(whole, 1);
  const auto odd = hn::RebindMask(d, hn::Eq(hn::And(quarter, one), one));
  const auto two = hn::Set(whole, 2);
  const auto sine_sign = hn::ShiftLeft<62>(hn::And(quarter, two));
  const auto cosine_sign = hn::ShiftLeft<62>(hn::And(hn::Add(quarter, one), two));
  return {hn::Xor(hn::IfThenElse(odd, cosine, sine), hn::BitCast(d, sine_sign)),
          hn::Xor(hn::IfThenElse(odd, sine, cosine), hn::BitCast(d, cosine_sign))};
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
