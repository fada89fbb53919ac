#include "lightproof/image/synthetic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>

#include "lightproof/core/error.h"
#include "lightproof/core/measure.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

using testing::HasSubstr;
using DoubleRgb = glm::dvec3;

constexpr Direction kAxis = {2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0};

/// Sum of radiance times weight(direction) times solid angle, at the texel centres.
template <class Weight>
DoubleRgb integral(const EnvironmentMap& map, const Weight& weight) {
  const auto [width, height] = map.radiance.extent();
  DoubleRgb sum(0.0);
  for (int y = 0; y < height; ++y) {
    const double solid_angle =
        2.0 * kPi / width * (cos_theta((y + 1.0) / height) - cos_theta(double(y) / height));
    for (int x = 0; x < width; ++x) {
      const Direction d = direction_from_square({(x + 0.5) / width, (y + 0.5) / height});
      sum += DoubleRgb(map.radiance(x, y)) * (weight(d) * solid_angle);
    }
  }
  return sum;
}

DoubleRgb integral(const EnvironmentMap& map) {
  return integral(map, [](Direction) { return 1.0; });
}

DoubleRgb irradiance(const EnvironmentMap& map, Direction normal) {
  return integral(map, [&](Direction d) { return std::max(0.0, glm::dot(normal, d)); });
}

void expect_near(DoubleRgb value, DoubleRgb expected, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], expected[i], tolerance);
}

constexpr Extent kSize = {512, 256};
/// Midpoint rule on smooth radiance: 4 pi (pi/H)^2 / 8 = 2.4e-4 at H = 256; the clamped cosine has
/// the same order across its kink.
constexpr double kSmooth = 5e-4;
/// A jump: the boundary's 2 W texels, each half wrong at worst and with random sign; bounded by
/// their whole solid angle over sqrt(2 W): 2 pi (pi/H) / sqrt(1024) = 2.4e-3.
constexpr double kJump = 5e-3;

Direction normal_at(double angle) {
  const Frame frame = frame_around(kAxis);
  return frame.to_world({std::sin(angle), 0.0, std::cos(angle)});
}

TEST(SyntheticMap, ConstantHasItsClosedForm) {
  const EnvironmentMap map = make_synthetic_map("constant", kSize);
  expect_near(integral(map), DoubleRgb(kSphere), 1e-10);
  expect_near(irradiance(map, normal_at(0.4)), DoubleRgb(kPi), kSmooth);
}

TEST(SyntheticMap, GradientHasItsClosedForm) {
  const EnvironmentMap map = make_synthetic_map("gradient", kSize);
  const DoubleRgb colour(1.0, 0.75, 0.5);
  expect_near(integral(map), kSphere * colour, kSmooth);
  for (const Direction n : {Direction{0, 0, 1}, Direction{0, 0, -1}, Direction{0.6, 0, 0.8}}) {
    expect_near(irradiance(map, n), kPi * (1.0 + n.z / 3.0) * colour, kSmooth);
  }
}

TEST(SyntheticMap, CosineLobeHasItsClosedForm) {
  const EnvironmentMap map = make_synthetic_map("cosine-lobe", kSize);
  expect_near(integral(map), DoubleRgb(kPi), kSmooth);
  for (const double angle : {0.0, 0.7, 1.5, 2.5, kPi}) {
    const double expected = 2.0 / 3.0 * ((kPi - angle) * std::cos(angle) + std::sin(angle));
    expect_near(irradiance(map, normal_at(angle)), DoubleRgb(expected), kSmooth);
  }
}

TEST(SyntheticMap, StepHasItsClosedForm) {
  const EnvironmentMap map = make_synthetic_map("step", kSize);
  expect_near(integral(map), DoubleRgb(2.0 * kPi), kJump);
  for (const double angle : {0.0, 0.7, 1.5, 2.5}) {
    const double expected = kPi * (1.0 + std::cos(angle)) / 2.0;
    expect_near(irradiance(map, normal_at(angle)), DoubleRgb(expected), kJump);
  }
}

TEST(SyntheticMap, TexelsAreTheFormulaAtTheirCentres) {
  const EnvironmentMap lobe = make_synthetic_map("cosine-lobe", {7, 5});
  const EnvironmentMap gradient = make_synthetic_map("gradient", {7, 5});
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) {
      const Direction d = direction_from_square({(x + 0.5) / 7, (y + 0.5) / 5});
      const double cosine = std::max(0.0, glm::dot(d, kAxis));
      EXPECT_NEAR(lobe.radiance(x, y).g, cosine, 1e-7);
      EXPECT_NEAR(gradient.radiance(x, y).b, 0.5 + 0.25 * d.z, 1e-7);
    }
  }
}

int count_if(const EnvironmentMap& map, bool (*condition)(Rgb)) {
  return static_cast<int>(std::ranges::count_if(map.radiance.values(), condition));
}

TEST(SyntheticMap, OneTexelLightsOneTexelAboveTheHorizon) {
  for (const Extent extent : {Extent{1, 1}, {2, 1}, {1, 9}, {8, 4}, {33, 17}, {64, 32}}) {
    const EnvironmentMap map = make_synthetic_map("one-texel", extent);
    EXPECT_EQ(count_if(map, [](Rgb rgb) { return rgb != Rgb(0.0F); }), 1);
    for (int y = 0; 2 * y < extent.height && extent.height > 1; ++y) {
      for (const Rgb rgb : map.radiance.row(y)) EXPECT_EQ(rgb, Rgb(0.0F));
    }
  }
}

TEST(SyntheticMap, SunHasNineTexelsAboveTheHorizon) {
  for (const Extent extent : {Extent{3, 6}, {12, 6}, {33, 17}, {512, 256}}) {
    const EnvironmentMap map = make_synthetic_map("sun-sky", extent);
    EXPECT_EQ(count_if(map, [](Rgb rgb) { return rgb.r > 1e4F; }), 9);
    for (int y = 0; 2 * y < extent.height; ++y) {
      for (const Rgb rgb : map.radiance.row(y)) EXPECT_LT(rgb.r, 1.0F);
    }
  }
}

TEST(SyntheticMap, CheckerAlternates) {
  const EnvironmentMap map = make_synthetic_map("checker", {16, 8});
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      const Rgb expected = (x + y) % 2 == 0 ? Rgb(1.0F, 0.5F, 0.25F) : Rgb(0.1F, 0.2F, 0.4F);
      EXPECT_EQ(map.radiance(x, y), expected);
    }
  }
}

TEST(SyntheticMap, BlackFirstRowIsTheOnlyBlack) {
  const EnvironmentMap map = make_synthetic_map("black-first-row", {8, 4});
  for (int y = 0; y < 4; ++y) {
    for (const Rgb rgb : map.radiance.row(y)) EXPECT_EQ(rgb == Rgb(0.0F), y == 0);
  }
  EXPECT_EQ(count_if(map, [](Rgb rgb) { return rgb.r > 0.0F && rgb.g > 0.0F && rgb.b > 0.0F; }),
            24);
}

TEST(SyntheticMap, ShowsSwappedChannels) {
  for (const char* name : {"gradient", "sun-sky", "checker", "black-first-row"}) {
    const EnvironmentMap map = make_synthetic_map(name, {32, 16});
    EXPECT_GT(count_if(map, [](Rgb rgb) { return rgb.r != rgb.b; }), 256) << name;
  }
}

TEST(SyntheticMap, WorksAtAnySize) {
  for (const SyntheticMap& row : synthetic_maps()) {
    for (const Extent extent :
         {Extent{1, 1}, {2, 1}, {1, 2}, {1, 7}, {7, 1}, {3, 2}, {5, 3}, {17, 31}}) {
      const EnvironmentMap map = make_synthetic_map(row.name, extent);
      EXPECT_EQ(map.name, row.name);
      EXPECT_EQ(map.radiance.extent(), extent);
      const auto good = [](Rgb rgb) {
        return std::isfinite(rgb.r + rgb.g + rgb.b) && std::min({rgb.r, rgb.g, rgb.b}) >= 0.0F;
      };
      EXPECT_TRUE(std::ranges::all_of(map.radiance.values(), good)) << row.name;
      EXPECT_GT(count_if(map, [](Rgb rgb) { return rgb.g > 0.0F; }), 0)
          << row.name << ' ' << extent.width << ' ' << extent.height;
    }
  }
}

std::string refusal(std::string_view name, Extent extent) {
  try {
    make_synthetic_map(name, extent);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(SyntheticMap, RefusesUnknownNamesAndSizes) {
  EXPECT_THAT(refusal("sunsky", {8, 4}), HasSubstr("sunsky"));
  for (const SyntheticMap& row : synthetic_maps()) {
    EXPECT_THAT(refusal("sunsky", {8, 4}), HasSubstr(std::string(row.name)));
  }
  EXPECT_THAT(refusal("constant", {0, 4}), HasSubstr("0 x 4"));
  EXPECT_THAT(refusal("constant", {8, -1}), HasSubstr("8 x -1"));
  EXPECT_THAT(refusal("constant", {32769, 1}), HasSubstr("32769"));
}

TEST(Luminance, WeighsTheChannels) {
  EnvironmentMap map{"three", Grid<Rgb>({3, 1}), {}};
  map.radiance(0, 0) = {1.0F, 0.0F, 0.0F};
  map.radiance(1, 0) = {0.0F, 2.0F, 0.0F};
  map.radiance(2, 0) = {0.0F, 0.0F, 4.0F};
  const Grid<double> luminance = luminance_of(map);
  EXPECT_DOUBLE_EQ(luminance(0, 0), 0.2126);
  EXPECT_DOUBLE_EQ(luminance(1, 0), 2 * 0.7152);
  EXPECT_DOUBLE_EQ(luminance(2, 0), 4 * 0.0722);
  EXPECT_DOUBLE_EQ(luminance_of(map, kPublishedLuminance)(1, 0), 2 * 0.5866);
}

}  // namespace
}  // namespace lightproof
