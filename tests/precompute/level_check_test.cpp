#include "lightproof/precompute/level_check.h"

#include <gtest/gtest.h>

#include "lightproof/image/synthetic.h"
#include "lightproof/precompute/levels.h"

namespace lightproof {
namespace {

constexpr std::size_t kTexels = 50;

const RandomStream kStream("level check test", 1);

PrecomputeRequest request_of(ProductRequest product, Projection projection) {
  PrecomputeRequest request;
  request.products = {product};
  request.projection = projection;
  return request;
}

LevelError check(
    const EnvironmentMap& map, const PrecomputeRequest& request, std::size_t level,
    const std::function<void(Rgb&)>& change = [](Rgb&) {}) {
  const auto plans = plan_levels(request.products.front(), request.projection);
  std::vector<MapLevel> made = make_levels(map, request, plans);
  for (Grid<Rgb>& face : made[level].faces) {
    for (Rgb& texel : face.values()) change(texel);
  }
  return check_level(map, request.projection, plans[level], made[level], kStream, kTexels);
}

// Texels are rounded to float, 6e-8 of a value; the oracle's own error is below 1e-5 of a cell.
TEST(LevelCheck, FindsNothingInExactLevels) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  for (const Projection projection :
       {Projection::lat_long, Projection::cube, Projection::mirrored_cube}) {
    const Extent extent = is_cube(projection) ? Extent{16, 16} : Extent{64, 32};
    const PrecomputeRequest request = request_of({Product::specular, extent, 3}, projection);
    for (const std::size_t level : {0U, 1U, 2U}) {
      EXPECT_LT(check(map, request, level).high, 1e-4)
          << info(projection).name << " level " << level;
    }
  }
  const PrecomputeRequest irradiance =
      request_of({Product::irradiance, Extent{16, 8}}, Projection::lat_long);
  EXPECT_LT(check(map, irradiance, 0).high, 1e-4);
}

// Every texel is off by the same factor: on a constant map by the same difference, so that the
// limits meet.
TEST(LevelCheck, MeasuresAFactorOnAllTexels) {
  const EnvironmentMap map = make_synthetic_map("constant", {32, 16});
  const PrecomputeRequest request =
      request_of({Product::specular, Extent{16, 8}, 2}, Projection::lat_long);
  const LevelError error = check(map, request, 1, [](Rgb& texel) { texel *= 1.01F; });
  EXPECT_NEAR(error.error, 0.01, 1e-5);
  EXPECT_NEAR(error.low, 0.01, 1e-4);
  EXPECT_NEAR(error.high, 0.01, 1e-4);
  EXPECT_EQ(error.texels, kTexels);
}

TEST(LevelCheck, SeesOneChannelAlone) {
  const EnvironmentMap map = make_synthetic_map("constant", {32, 16});
  const PrecomputeRequest request =
      request_of({Product::irradiance, Extent{16, 8}}, Projection::lat_long);
  EXPECT_NEAR(check(map, request, 0, [](Rgb& texel) { texel.g *= 1.02F; }).error, 0.02, 1e-5);
}

TEST(LevelCheck, HoldsAMirrorToTheMeansOverItsTexels) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  // No divisor of the map's size.
  const PrecomputeRequest request =
      request_of({Product::specular, Extent{24, 10}, 1}, Projection::lat_long);
  EXPECT_LT(check(map, request, 0).high, 1e-6);
}

TEST(LevelCheck, CallsAMapWithoutLightExact) {
  EnvironmentMap map = make_synthetic_map("constant", {8, 4});
  for (Rgb& texel : map.radiance.values()) texel = Rgb(0.0F);
  const PrecomputeRequest request =
      request_of({Product::irradiance, Extent{4, 2}}, Projection::lat_long);
  EXPECT_EQ(check(map, request, 0).error, 0.0);
}

// The limits are those of a 95 % interval: of 100 checks of one level with errors of very different
// sizes, each over 50 texels, 5 are expected to miss the true value; more than 15 with a
// probability of 4e-5, and the central limit's own error is small beside that.
TEST(LevelCheck, HasTheTrueErrorBetweenItsLimits) {
  const EnvironmentMap map = make_synthetic_map("constant", {8, 4});
  const PrecomputeRequest request =
      request_of({Product::specular, Extent{64, 32}, 1}, Projection::lat_long);
  const auto plans = plan_levels(request.products.front(), request.projection);
  std::vector<MapLevel> made = make_levels(map, request, plans);
  Grid<Rgb>& face = made[0].faces[0];
  const float exact = face(0, 0).r;
  double truth = 0.0;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double off = 0.001 * (x % 7);
      face(x, y) = Rgb(exact * static_cast<float>(1.0 + off));
      truth += off * off * solid_angle_of(request.projection, {64, 32}, {0, x, y});
    }
  }
  truth = std::sqrt(truth / (4.0 * kPi));
  int missed = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const LevelError error =
        check_level(map, request.projection, plans[0], made[0], kStream.substream(i), kTexels);
    missed += truth < error.low || truth > error.high ? 1 : 0;
  }
  EXPECT_LE(missed, 15);
}

TEST(BrdfMapCheck, MeasuresAShiftOfAllTexels) {
  BrdfMap map{Grid<glm::vec2>({16, 16})};
  const Grid<ScaleBias> exact = brdf_map({16, 16}, Masking::height_correlated);
  for (std::size_t i = 0; i < exact.values().size(); ++i) {
    const ScaleBias& value = exact.values()[i];
    map.values.values()[i] = {value.scale + 3e-3, value.bias - 4e-3};
  }
  const LevelError shifted = check_brdf_map(map, Masking::height_correlated, kStream, kTexels);
  EXPECT_NEAR(shifted.error, 5e-3, 1e-4);
  EXPECT_GT(check_brdf_map(map, Masking::karis, kStream, kTexels).error, 0.02)
      << "another masking is another map";
}

}  // namespace
}  // namespace lightproof
