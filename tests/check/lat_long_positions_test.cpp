// Places of many directions at once are those of the definition.
#include "lightproof/check/lat_long_positions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

// The approximation is off by 2e-8 of the square, up to 1.3e-7 in angle; the step leaves the third
// power of it, so that roundings remain: those of s grow with the distance from the axis, 1e-3 at
// the least.
TEST(LatLongPositions, AreThoseOfTheDefinitionAwayFromThePoles) {
  const RandomStream stream("positions", 1);
  std::vector<DumpedSample> samples;
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    const auto [s, t] = stream.point(i);
    samples.push_back({direction_from_square({s, 0.001 + 0.998 * t}), {1.0}});
  }
  samples.push_back({{1.0, 0.0, 0.0}, {1.0}});
  samples.push_back({{-1.0, 0.0, 0.0}, {1.0}});
  samples.push_back({{0.0, -1.0, 0.0}, {1.0}});
  LatLongPositions positions(samples.size());
  positions.find(samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Direction d = samples[i].direction;
    const SquarePoint exact = square_from_direction(d);
    const double turns = std::abs(positions.s(i) - exact.s);
    EXPECT_LE(std::min(turns, 1.0 - turns), 1e-12) << i;
    EXPECT_NEAR(positions.t(i), exact.t, 1e-15) << i;
    EXPECT_NEAR(positions.sine(i), std::hypot(d.x, d.y), 1e-15) << i;
  }
}

TEST(LatLongPositions, OfNoDirectionHaveNoNumbers) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const std::vector<DumpedSample> samples = {{{kNaN, kNaN, kNaN}, {1.0}}, {{0.0, 0.6, 0.8}, {1.0}}};
  LatLongPositions positions(2);
  positions.find(samples);
  EXPECT_TRUE(std::isnan(positions.sine(0)));
  EXPECT_NEAR(positions.sine(1), 0.6, 1e-15);
}

}  // namespace
}  // namespace lightproof
