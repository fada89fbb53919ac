// Sine and cosine together, of an angle in turns: what turns a position of a map into a direction.
// The vectors' form, sin_cos-inl.h, is the same polynomial.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "lightproof/core/measure.h"
#include "lightproof/core/select.h"

namespace lightproof {

/// 1/first!, -1/(first + 2)!, …, of first 0 or 1: the terms of the Taylor series of cosine and
/// sine.
template <std::size_t kTerms>
constexpr std::array<double, kTerms> alternating_inverse_factorials(int first) {
  std::array<double, kTerms> terms{};
  double factorial = 1.0;
  for (std::size_t i = 0; i < kTerms; ++i) {
    const int k = first + 2 * static_cast<int>(i);
    terms[i] = (i % 2 == 0 ? 1.0 : -1.0) / factorial;
    factorial *= (k + 1) * (k + 2);
  }
  return terms;
}

/// The terms that leave less than 2^-53 of sine and cosine on an eighth of a turn.
inline constexpr std::array<double, 8> kSineTerms = alternating_inverse_factorials<8>(1);
inline constexpr std::array<double, 9> kCosineTerms = alternating_inverse_factorials<9>(0);

struct SinCosOfTurns {
  double sin;
  double cos;
};

/// Sine and cosine of 2 pi x, x in [0, 1], with errors of some 2^-53; near the sine's zeros its
/// error is so relative to it.
inline SinCosOfTurns sin_cos_of_turns(double x) {
  const double quarters = 4.0 * x;
  // The nearest whole number of quarters, from the number of whole eighths: truncation of what is
  // not negative is one instruction everywhere, which rounding is not.
  const std::int32_t quarter = (static_cast<std::int32_t>(8.0 * x) + 1) / 2;
  const double angle = (quarters - quarter) * (0.5 * kPi);
  const double square = angle * angle;
  double sine = kSineTerms.back();
  for (std::size_t k = kSineTerms.size() - 1; k-- > 0;) sine = sine * square + kSineTerms[k];
  sine *= angle;
  double cosine = kCosineTerms.back();
  for (std::size_t k = kCosineTerms.size() - 1; k-- > 0;) {
    cosine = cosine * square + kCosineTerms[k];
  }
  // From quarter to quarter the two change places, and one of them its sign.
  const bool odd = (quarter & 1) != 0;
  return {negate_if((quarter & 2) != 0, select(odd, cosine, sine)),
          negate_if(((quarter + 1) & 2) != 0, select(odd, sine, cosine))};
}

/// The largest angle of sin_cos_of_small(), in radians: that of a texel of a map 256 wide.
inline constexpr double kSmallAngle = kPi / 128.0;

/// Sine and cosine of an angle from 0 to kSmallAngle, in radians, with errors of some 2^-53; the
/// sine's is so relative to it.
inline SinCosOfTurns sin_cos_of_small(double angle) {
  const double square = angle * angle;
  const double fourth = square * square;
  return {
      angle * ((1.0 + square * kSineTerms[1]) + fourth * (kSineTerms[2] + square * kSineTerms[3])),
      (1.0 + square * kCosineTerms[1]) + fourth * (kCosineTerms[2] + square * kCosineTerms[3])};
}

}  // namespace lightproof
