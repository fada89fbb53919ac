#include "lightproof/image/map_format.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lightproof/core/error.h"
#include "lightproof/core/random.h"
#include "lightproof/image/stored_value.h"

namespace lightproof {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Of a 16-bit float, by its definition in IEEE 754.
double value_of_half(unsigned bits) {
  const double sign = (bits & 0x8000U) != 0 ? -1.0 : 1.0;
  const int exponent = static_cast<int>(bits >> 10U & 31U);
  const double fraction = bits & 0x3ffU;
  if (exponent == 0) return sign * std::ldexp(fraction, -24);
  return sign * std::ldexp(1024.0 + fraction, exponent - 25);
}

constexpr unsigned kInfinityBits = 0x7c00;

TEST(Halves, KeepEveryValueOfTheirs) {
  for (unsigned bits = 0; bits < kInfinityBits; ++bits) {
    for (const unsigned sign : {0U, 0x8000U}) {
      const double value = value_of_half(bits | sign);
      EXPECT_EQ(half_bits(static_cast<float>(value)), bits | sign);
      EXPECT_EQ(static_cast<double>(float_of_half(static_cast<std::uint16_t>(bits | sign))), value);
    }
  }
}

// Between neighbours the middle goes to the one with an even last bit, all else to the nearer one.
TEST(Halves, AreTheNearestTiesToEven) {
  for (unsigned bits = 0; bits + 1 < kInfinityBits; ++bits) {
    const double low = value_of_half(bits);
    const double high = value_of_half(bits + 1);
    const auto middle = static_cast<float>(0.5 * (low + high));  // exact: 12 bits
    const unsigned even = bits % 2 == 0 ? bits : bits + 1;
    ASSERT_EQ(half_bits(middle), even);
    ASSERT_EQ(half_bits(std::nextafter(middle, 0.0F)), bits);
    ASSERT_EQ(half_bits(std::nextafter(middle, HUGE_VALF)), bits + 1);
  }
}

TEST(Halves, AreClampedToTheLargest) {
  EXPECT_EQ(half_bits(65504.0F), 0x7bff);
  EXPECT_EQ(half_bits(1e9F), 0x7bff);
  EXPECT_EQ(half_bits(-HUGE_VALF), 0xfbff);
  EXPECT_EQ(value_of_half(0x7bff), kLargestHalf);
}

double largest_of(Rgb rgb) { return static_cast<double>(std::max({rgb.r, rgb.g, rgb.b})); }

// Mantissas count 256ths of the power of two above the largest channel: half a step is at most
// 1/512 of that power, 1/256 of the channel. If the largest mantissa would be 256, the step
// doubles, but then the channel is the power of two but for half a step.
TEST(Rgbe, IsWithinHalfAStepOfEveryChannel) {
  const RandomStream stream("rgbe", 1);
  for (std::uint64_t i = 0; i < 50000; ++i) {
    const SquarePoint a = stream.point(2 * i);
    const SquarePoint b = stream.point(2 * i + 1);
    const auto scale = static_cast<float>(std::exp2(200.0 * (a.s - 0.5)));
    const Rgb rgb = scale * Rgb(a.t, b.s * b.s, std::pow(b.t, 20.0));
    const Rgb back = rgb_of(rgbe_of(rgb));
    for (int c = 0; c < 3; ++c) {
      const double error = std::abs(static_cast<double>(back[c]) - static_cast<double>(rgb[c]));
      EXPECT_LE(error, largest_of(rgb) / 256.0);
    }
  }
}

TEST(Rgbe, KeepsEveryNormalisedPixel) {
  for (unsigned exponent = 1; exponent < 256; ++exponent) {
    for (unsigned mantissa = 128; mantissa < 256; ++mantissa) {
      const RgbePixel pixel = {{static_cast<std::uint8_t>(mantissa), 3, 0},
                               static_cast<std::uint8_t>(exponent)};
      const RgbePixel again = rgbe_of(rgb_of(pixel));
      ASSERT_EQ(again.mantissas, pixel.mantissas);
      ASSERT_EQ(again.exponent, pixel.exponent);
    }
  }
}

TEST(Rgbe, RoundsUpIntoTheNextExponent) {
  const RgbePixel pixel = rgbe_of({255.6F / 256.0F, 0.5F, 0.0F});
  EXPECT_EQ(pixel.exponent, 129);
  EXPECT_EQ(pixel.mantissas, (std::array<std::uint8_t, 3>{128, 64, 0}));
}

TEST(Rgbe, EndsWhereItSays) {
  const auto largest = static_cast<float>(kLargestRgbe);
  EXPECT_EQ(rgb_of(rgbe_of(Rgb(largest))).r, largest);
  EXPECT_EQ(rgb_of(rgbe_of(Rgb(std::numeric_limits<float>::max()))).r, largest);
  EXPECT_EQ(rgb_of(rgbe_of(Rgb(0.0F))), Rgb(0.0F));
  EXPECT_EQ(rgb_of(rgbe_of(Rgb(-1.0F, 0.5F, 0.0F))), Rgb(0.0F, 0.5F, 0.0F));
  // The smallest exponent of a pixel that is not black is 1: 2^-128 up to 2^-127.
  EXPECT_EQ(rgb_of(rgbe_of(Rgb(0x1p-128F))).r, 0x1p-128F);
  EXPECT_EQ(rgb_of(rgbe_of(Rgb(0x1p-130F))), Rgb(0.0F));
}

// c / (1 + c) = 1/2, whose sRGB code is 1.055 * 2^(-1/2.4) - 0.055 = 0.735357.
TEST(ToneMappedByte, TurnsOneIntoHalf) {
  EXPECT_EQ(tone_mapped_byte(1.0F), 188);  // 187.52
  EXPECT_EQ(tone_mapped_byte(0.0F), 0);
  EXPECT_EQ(tone_mapped_byte(-3.0F), 0);
  EXPECT_EQ(tone_mapped_byte(HUGE_VALF), 255);
  EXPECT_EQ(tone_mapped_byte(1e30F), 255);
  // 3 becomes 3/4: 1.055 * 0.75^(1/2.4) - 0.055 = 0.880825.
  EXPECT_EQ(tone_mapped_byte(3.0F), 225);  // 224.61
}

MapLevels two_levels() {
  MapLevels map = {.projection = Projection::cube, .levels = {}};
  for (const int size : {4, 2}) {
    map.levels.push_back({0.0, std::vector<Grid<Rgb>>(6, Grid<Rgb>({size, size}, Rgb(1.0F)))});
  }
  return map;
}

TEST(FormatLoss, IsNoneOfAnOrdinaryMap) {
  for (const MapFormatInfo& format : map_formats()) {
    const FormatLoss loss = loss_in(format.format, two_levels());
    EXPECT_TRUE(loss.none()) << format.name;
    EXPECT_EQ(describe(loss, format.format, two_levels()), "");
  }
}

TEST(FormatLoss, FindsWhatOverflowsSixteenBits) {
  MapLevels map = two_levels();
  map.levels[0].faces[0](3, 1) = Rgb(65504.0F, 65505.0F, 1e5F);
  map.levels[1].faces[5](0, 1) = Rgb(200.0F, 2e5F, 1e4F);
  const FormatLoss loss = loss_in(MapFormat::ktx2, map);
  EXPECT_TRUE(loss.is_refused());
  EXPECT_EQ(loss.too_large.count, 3U);
  EXPECT_EQ(loss.too_large.level, 1);
  EXPECT_EQ(loss.too_large.texel, (LevelTexel{5, 0, 1}));
  EXPECT_EQ(describe(loss, MapFormat::ktx2, map),
            "3 values are above 65504, the largest that KTX 2.0 holds: up to 200000 (level 1, face "
            "-Z, column 0, row 1).");
  EXPECT_TRUE(loss_in(MapFormat::exr, map).none());
  EXPECT_FALSE(loss_in(MapFormat::hdr, map).is_refused());
}

TEST(FormatLoss, FindsWhatVanishesInSixteenBits) {
  MapLevels map = two_levels();
  map.levels[0].faces[1](0, 0) = Rgb(0x1p-25F, 0x1.2p-25F, 0x1p-14F);  // a tie to even, rounded up
  const FormatLoss loss = loss_in(MapFormat::ktx2, map);
  EXPECT_FALSE(loss.is_refused());
  EXPECT_FALSE(loss.none());
  EXPECT_EQ(loss.vanished.count, 1U);
  EXPECT_EQ(loss.vanished.worst, 0x1p-25);
  EXPECT_EQ(loss.coarse.count, 1U) << "stored as 2^-24, 78 % more";
  EXPECT_THAT(describe(loss, MapFormat::ktx2, map),
              AllOf(HasSubstr("1 value becomes 0, too small for 16 bits: up to 2.98e-08"),
                    HasSubstr("1 value is rounded by more than 1 %"),
                    HasSubstr("level 0, face -X, column 0, row 0")));
}

TEST(FormatLoss, FindsWhatVanishesBesideABrightChannel) {
  MapLevels map = two_levels();
  map.levels[0].faces[2](1, 1) =
      Rgb(1.0F, 0x1p-8F, 0x1p-9F);  // steps of 1/128: half of one, a quarter
  const FormatLoss loss = loss_in(MapFormat::hdr, map);
  EXPECT_EQ(loss.vanished.count, 2U) << "ties go to even, here 0";
  EXPECT_EQ(loss.vanished.worst, 0x1p-8);
  EXPECT_THAT(describe(loss, MapFormat::hdr, map),
              HasSubstr("2 values become 0, too small beside the texel's largest channel"));
}

TEST(FormatLoss, FindsNegativeValuesWhereThereIsNoSign) {
  MapLevels map = two_levels();
  map.levels[0].faces[2](1, 1).r = -0.25F;
  map.levels[0].faces[3](1, 1).r = -0.5F;
  for (const MapFormat format : {MapFormat::hdr, MapFormat::png}) {
    const FormatLoss loss = loss_in(format, map);
    EXPECT_TRUE(loss.is_refused());
    EXPECT_EQ(loss.negative.count, 2U);
    EXPECT_EQ(loss.negative.worst, -0.5);
  }
  EXPECT_TRUE(loss_in(MapFormat::ktx2, map).none());
  EXPECT_TRUE(loss_in(MapFormat::exr, map).none());
}

TEST(FormatLoss, FindsValuesThatAreNotFiniteInEveryFormat) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), HUGE_VALF, -HUGE_VALF}) {
    MapLevels map = two_levels();
    map.levels[1].faces[4](1, 0).b = bad;
    for (const MapFormatInfo& format : map_formats()) {
      const FormatLoss loss = loss_in(format.format, map);
      EXPECT_EQ(loss.not_finite.count, 1U) << format.name;
      EXPECT_EQ(loss.too_large.count, 0U) << format.name;
      EXPECT_THAT(
          describe(loss, format.format, map),
          HasSubstr("1 value is not finite, the first (level 1, face +Z, column 1, row 0)"));
      EXPECT_THROW(check_range("a", format.format, map, OutOfRange::clamped), InputError);
    }
  }
}

TEST(FormatLoss, NamesNoFaceOfALatLongMap) {
  MapLevels map = {.levels = {{0.0, {Grid<Rgb>({4, 2}, Rgb(1e6F))}}}};
  EXPECT_EQ(describe(loss_in(MapFormat::ktx2, map), MapFormat::ktx2, map),
            "24 values are above 65504, the largest that KTX 2.0 holds: up to 1e+06 (level 0, "
            "column 0, row 0).");
}

TEST(CheckRange, RefusesWithTheFileAndTheValue) {
  MapLevels map = two_levels();
  map.levels[0].faces[0](0, 0).r = 1e5F;
  try {
    check_range("out/specular.ktx2", MapFormat::ktx2, map, OutOfRange::refused);
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "out/specular.ktx2: not written: 1 value is above 65504, the largest that KTX 2.0 "
              "holds: up to 100000 (level 0, face +X, column 0, row 0). OpenEXR holds them.");
  }
  check_range("a", MapFormat::ktx2, map, OutOfRange::clamped);
  check_range("a", MapFormat::exr, map, OutOfRange::refused);
}

TEST(MapFormats, AreKnownByTheirNames) {
  for (const MapFormatInfo& row : map_formats()) {
    EXPECT_EQ(map_format_by_name(row.name), row.format);
    EXPECT_EQ(info(row.format).name, row.name);
  }
  EXPECT_EQ(map_format_by_name("dds"), std::nullopt);
}

}  // namespace
}  // namespace lightproof
