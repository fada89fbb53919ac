// How many rows a prefiltered map needs, against maps that were prefiltered.
#include "lightproof/recommend/map_rows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/image/synthetic.h"
#include "lightproof/prefilter/prefilter.h"
#include "lightproof/prefilter/radiance_look_up.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// The error over the sphere of a prefiltered map of so many rows, looked up bilinearly, against
/// one whose texels are a sixteenth as large at least; relative to the mean.
double measured_error(const EnvironmentMap& map, const Lobe& lobe, int rows) {
  constexpr Extent kFine = {512, 256};
  const PrefilteredLevel wanted[] = {{lobe, {2 * rows, rows}}, {lobe, kFine}};
  const auto levels = prefilter(map.radiance, wanted);
  double square = 0.0;
  double sum = 0.0;
  for (int y = 0; y < kFine.height; ++y) {
    const double area = texel_solid_angle(kFine, y);
    for (int x = 0; x < kFine.width; ++x) {
      const SquarePoint at = {(x + 0.5) / kFine.width, (y + 0.5) / kFine.height};
      const double exact = luminance_of(levels[1](x, y), map.weights);
      const double off = luminance_of(Rgb(look_up_bilinear(levels[0], at)), map.weights) - exact;
      square += area * off * off;
      sum += area * exact;
    }
  }
  return std::sqrt(square / kSphere) / (sum / kSphere);
}

constexpr std::string_view kMaps[] = {"one-texel", "sun-sky", "checker", "gradient"};

TEST(MapRows, AreEnoughForTheError) {
  for (const std::string_view name : kMaps) {
    const EnvironmentMap map = make_synthetic_map(name, {128, 64});
    const MapSummary summary = summarise(map);
    for (const Lobe& lobe : {Lobe(PhongLobe{20.0}), Lobe(GgxLobe{0.25})}) {
      for (const double error : {0.05, 0.3}) {
        const auto rows = rows_needed(summary, lobe, error);
        ASSERT_TRUE(rows) << name;
        if (*rows > 64) continue;  // what is compared with must be finer by far
        EXPECT_LE(measured_error(map, lobe, *rows), error) << name << ", " << *rows << " rows";
      }
    }
  }
}

// Of a single small light the spectrum is the worst that the bound allows for: a quarter of the
// rows is too few.
TEST(MapRows, AreNotManyTimesTooManyForASmallSun) {
  const EnvironmentMap map = make_synthetic_map("one-texel", {512, 256});
  const MapSummary summary = summarise(map);
  for (const Lobe& lobe : {Lobe(PhongLobe{20.0}), Lobe(PhongLobe{80.0})}) {
    const auto rows = rows_needed(summary, lobe, 0.2);
    ASSERT_TRUE(rows);
    EXPECT_GT(measured_error(map, lobe, *rows / 4), 0.2) << *rows;
  }
}

TEST(MapRows, FollowErrorLobeAndLight) {
  const MapSummary even = summarise(make_synthetic_map("constant", {64, 32}));
  EXPECT_EQ(rows_needed(even, PhongLobe{1000.0}, 1e-3), 2);
  const MapSummary sun = summarise(make_synthetic_map("sun-sky", {128, 64}));
  const auto rows = [&](double exponent, double error) {
    return rows_needed(sun, PhongLobe{exponent}, error).value();
  };
  EXPECT_LT(rows(10.0, 0.1), rows(100.0, 0.1));
  EXPECT_LT(rows(10.0, 0.1), rows(10.0, 0.01));
  EXPECT_LT(rows_needed(summarise(make_synthetic_map("gradient", {128, 64})), PhongLobe{10.0}, 0.1),
            rows(10.0, 0.1));
  EXPECT_FALSE(rows_needed(sun, PhongLobe{1e5}, 1e-4));
  EXPECT_EQ(rows_needed(summarise({"black", Grid<Rgb>({8, 4})}), PhongLobe{10.0}, 0.1), 2);
}

}  // namespace
}  // namespace lightproof
