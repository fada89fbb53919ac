// Hashes against their formulas, worked out another way; and what floats do to them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "lightproof/points/pcg3d.h"
#include "lightproof/points/sine_hash.h"
#include "lightproof/points/unit_fraction.h"
#include "tests/points/points.h"

namespace lightproof::test {
namespace {

constexpr std::uint64_t kModulus = std::uint64_t{1} << 32U;

/// The paper's lines in words of 64 bits with a remainder after every step, three names in place of
/// an array.
std::array<std::uint32_t, 3> pcg3d_in_64_bits(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  for (std::uint64_t* word : {&x, &y, &z}) *word = (*word * 1664525U + 1013904223U) % kModulus;
  for (int round = 0; round < 2; ++round) {
    x = (x + y * z % kModulus) % kModulus;
    y = (y + z * x % kModulus) % kModulus;
    z = (z + x * y % kModulus) % kModulus;
    if (round == 1) break;
    for (std::uint64_t* word : {&x, &y, &z}) *word ^= *word / 65536U;
  }
  return {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
          static_cast<std::uint32_t>(z)};
}

TEST(Pcg3d, IsItsFormula) {
  // From a program in Python, whose numbers have no end.
  EXPECT_EQ(pcg3d({0, 0, 0}),
            (std::array<std::uint32_t, 3>{0x9bafd7c6U, 0xa8e88a6bU, 0x3f15482cU}));
  EXPECT_EQ(pcg3d({1, 2, 3}),
            (std::array<std::uint32_t, 3>{0xfa9f79a6U, 0x48f2f44cU, 0x596f5ab1U}));
  EXPECT_EQ(pcg3d({1919, 1079, 1U << 24U}),
            (std::array<std::uint32_t, 3>{0xf3df5a77U, 0x31678e48U, 0x76eea099U}));
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const std::uint32_t x = i * 0x9e3779b9U;
    const std::uint32_t y = ~x;
    const std::uint32_t z = x / 7U;
    EXPECT_EQ(pcg3d({x, y, z}), pcg3d_in_64_bits(x, y, z));
  }
}

TEST(Pcg3dPoints, AreTheTop24BitsOfTwoWords) {
  for (const std::uint32_t index : {0U, 1U, 1U << 24U, (1U << 24U) + 1U, 0xffffffffU}) {
    const WordPair pixel = random_words(5);
    const auto words = pcg3d({pixel.s, pixel.t, index});
    const SquarePoint point = Pcg3dPoints<FrameIndex::whole>(5U).point(index);
    EXPECT_EQ(point.s, std::floor(words[0] * 0x1p-8) * 0x1p-24);
    EXPECT_EQ(point.t, std::floor(words[1] * 0x1p-8) * 0x1p-24);
  }
}

// The top bits are never 1, even as a float; the whole word is.
TEST(UnitFraction, StaysBelowOne) {
  EXPECT_EQ(from_top_24_bits(0xffffffffU), 1.0 - 0x1p-24);
  EXPECT_LT(static_cast<float>(from_top_24_bits(0xffffffffU)), 1.0F);
  EXPECT_EQ(from_fixed_point(0xffffffffU), 1.0 - 0x1p-32);
  EXPECT_EQ(static_cast<float>(0xffffffffU) * 0x1p-32F, 1.0F);
  EXPECT_EQ(static_cast<float>(0xffffff80U) * 0x1p-32F, 1.0F);
  EXPECT_LT(static_cast<float>(0xffffff7fU) * 0x1p-32F, 1.0F);
}

TEST(UnitFraction, TakesFractionsAsShadersDo) {
  EXPECT_EQ(fract(2.75F), 0.75F);
  EXPECT_EQ(fract(-0.25F), 0.75F);
  EXPECT_EQ(fract(-0x1p-26F), 1.0F);
  EXPECT_EQ(wrapped(1.25), 0.25);
  EXPECT_EQ(wrapped(1.0), 0.0);
  EXPECT_EQ(wrapped(0.25), 0.25);
}

TEST(FrameIndex, IsRoundedOrStandsStillAsAFloat) {
  constexpr std::uint32_t kLast = 1U << 24U;
  float counter = static_cast<float>(kLast - 2U);
  for (std::uint32_t index = kLast - 2U; index < kLast + 4U; ++index) {
    EXPECT_EQ(static_cast<float>(seen_by_shader<FrameIndex::counted>(index)), counter);
    counter += 1.0F;
  }
  EXPECT_EQ(seen_by_shader<FrameIndex::converted>(kLast - 1U), kLast - 1U);
  EXPECT_EQ(seen_by_shader<FrameIndex::converted>(kLast + 1U), kLast);  // the even one of two
  EXPECT_EQ(seen_by_shader<FrameIndex::converted>(kLast + 3U), kLast + 4U);
  EXPECT_EQ(seen_by_shader<FrameIndex::converted>(0xffffffffU), 0xffffffffU);
  EXPECT_EQ(seen_by_shader<FrameIndex::whole>(kLast + 1U), kLast + 1U);
}

TEST(SineHash, IsItsFormulaInFloats) {
  EXPECT_EQ(sine_hash(0.0F, 0.0F), 0.0F);
  // sin(12.9898) 43758.5453 = 43758.5453 × 0.4081...: the float has 9 bits behind the point.
  const auto product = static_cast<float>(std::sin(static_cast<double>(12.9898F))) * 43758.5453F;
  EXPECT_EQ(sine_hash(1.0F, 0.0F), product - std::floor(product));
  for (const float x : {1.0F, 100.0F, 65535.0F}) {
    const float value = sine_hash(x, 3.0F);
    EXPECT_GE(value, 0.0F);
    EXPECT_LT(value, 1.0F);
  }
}

// Where |sin| is above 3/4, two thirds of all places, the product is above 2^15 and has 8 bits
// behind the point: of so many places at least half are multiples of 1/256.
TEST(SineHash, HasFewValues) {
  std::size_t coarse = 0;
  const auto points = window_of("sine hash", 65536, 0, 65536);
  for (const SquarePoint p : points) {
    coarse += std::fmod(p.s * 256.0, 1.0) == 0.0 ? 1 : 0;
  }
  // |sin| > 0x1p15 / 43758.5 = .7489 in a share of 1 - 2 asin(.7489)/pi = .4610; of the rest, half
  // and a quarter of the finer values are multiples, too.
  EXPECT_GT(coarse, points.size() / 2);
}

}  // namespace
}  // namespace lightproof::test
