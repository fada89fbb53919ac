#include "lightproof/warp/sin_cos.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lightproof {
namespace {

void expect_exact(double turns) {
  // Beside an odd number of quarters the angle itself must not be rounded: it is taken from the
  // nearest quarter, as a difference that is exact.
  const auto quarter = static_cast<int>(std::lround(4.0 * turns));
  const long double rest =
      0.5L * std::numbers::pi_v<long double> * (4.0L * static_cast<long double>(turns) - quarter);
  const long double sines[] = {std::sin(rest), std::cos(rest), -std::sin(rest), -std::cos(rest)};
  const long double sine = sines[quarter % 4];
  const long double cosine = sines[(quarter + 1) % 4];
  const SinCosOfTurns found = sin_cos_of_turns(turns);
  // The angle and each of both are rounded to 2^-53 of themselves, the polynomial's steps together
  // to less than two such.
  constexpr long double kRoundings = 4.0L * 0x1p-53L;
  EXPECT_LE(std::abs(found.sin - sine), kRoundings * std::abs(sine)) << turns;
  EXPECT_LE(std::abs(found.cos - cosine), kRoundings * std::abs(cosine)) << turns;
}

TEST(SinCosOfTurns, AreExactToSomeRoundings) {
  for (int i = 0; i <= 20'000; ++i) expect_exact(i / 20'000.0);
}

TEST(SinCosOfTurns, AreExactBesideTheirZeros) {
  for (int quarter = 0; quarter <= 4; ++quarter) {
    const double at = 0.25 * quarter;
    for (int exponent = 3; exponent < 1000; exponent += 7) {
      const double away = std::ldexp(1.0, -exponent);
      if (at + away <= 1.0) expect_exact(at + away);
      if (at - away >= 0.0) expect_exact(at - away);
    }
    expect_exact(at);
  }
}

TEST(SinCosOfSmall, AreExactToSomeRoundings) {
  // Three roundings and what the series leave out, which is less than another.
  constexpr long double kRoundings = 4.0L * 0x1p-53L;
  for (int i = 0; i <= 20'000; ++i) {
    const double angle = kSmallAngle * i / 20'000.0;
    const long double exact = angle;
    const SinCosOfTurns found = sin_cos_of_small(angle);
    EXPECT_LE(std::abs(found.sin - std::sin(exact)), kRoundings * std::sin(exact)) << angle;
    EXPECT_LE(std::abs(found.cos - std::cos(exact)), kRoundings) << angle;
  }
}

}  // namespace
}  // namespace lightproof
