// What stands between texels and directions: resampling, mip pyramids, interpolation.
#include <gtest/gtest.h>

#include <boost/math/special_functions/legendre.hpp>
#include <cmath>

#include "lightproof/core/random.h"
#include "lightproof/prefilter/mip_pyramid.h"
#include "lightproof/prefilter/resample.h"
#include "lightproof/prefilter/sphere_interpolation.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

Grid<Rgb> noise(Extent extent) {
  const RandomStream stream("LookUps.noise", 1);
  Grid<Rgb> map(extent);
  for (std::size_t i = 0; i < map.values().size(); ++i) {
    const SquarePoint u = stream.point(i);
    map.values()[i] = Rgb(u.s, u.t, 1.0);
  }
  return map;
}

TEST(Resampled, IsTheMeanOverSolidAngle) {
  Grid<Rgb> map({2, 4});
  for (int y = 0; y < 4; ++y) {
    map(0, y) = Rgb(static_cast<float>(y));
    map(1, y) = Rgb(10.0F);
  }
  const Grid<Rgb> half = resampled(map, {2, 2});
  // Rows 0 and 1 reach from the nadir to 45 degrees and on to the horizon: 1 - cos 45 and cos 45.
  const double outer = 1.0 - std::cos(0.25 * kPi);
  EXPECT_NEAR(half(0, 0).r, 1.0 - outer, 1e-6);
  EXPECT_NEAR(half(0, 1).r, 2.0 * (1.0 - outer) + 3.0 * outer, 1e-6);
  EXPECT_EQ(half(1, 0).r, 10.0F);
}

TEST(Resampled, KeepsTheLightAtAnySize) {
  const Extent from = {37, 19};
  const Grid<Rgb> map = noise(from);
  const auto light = [](const Grid<Rgb>& grid) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < grid.extent().height; ++y) {
      for (const Rgb value : grid.row(y)) {
        sum += texel_solid_angle(grid.extent(), y) * glm::dvec3(value);
      }
    }
    return sum;
  };
  const glm::dvec3 whole = light(map);
  for (const Extent to : {Extent{1, 1}, Extent{5, 3}, Extent{36, 18}, Extent{100, 71}}) {
    const glm::dvec3 kept = light(resampled(map, to));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(kept[c], whole[c], 0x1p-23 * whole[c]);
  }
}

TEST(MipPyramid, InterpolatesBetweenItsLevels) {
  const Grid<Rgb> map = noise({16, 8});
  const MipPyramid pyramid(map);
  const SquarePoint centre = {3.5 / 16, 2.5 / 8};
  EXPECT_NEAR(pyramid.trilinear(centre, 0.0).x, static_cast<double>(map(3, 2).r), 1e-12);
  const Grid<Rgb> half = resampled(map, {8, 4});
  const SquarePoint of_half = {3.5 / 8, 2.5 / 4};
  EXPECT_NEAR(pyramid.trilinear(of_half, 1.0).x, static_cast<double>(half(3, 2).r), 1e-12);
  const double finer = pyramid.trilinear(of_half, 0.0).x;
  EXPECT_NEAR(pyramid.trilinear(of_half, 0.25).x,
              0.75 * finer + 0.25 * static_cast<double>(half(3, 2).r), 1e-12);
  const glm::dvec3 mean = pyramid.trilinear({0.1, 0.9}, 100.0);
  EXPECT_NEAR(mean.x, static_cast<double>(resampled(map, {1, 1})(0, 0).r), 1e-6) << "the last one";
}

TEST(SphereInterpolation, FollowsASphericalHarmonic) {
  // P_12 around a tilted axis, on 128 x 64 points: 12/64 pi = 0.59 radians from row to row. The
  // remainder of the polynomial of degree 7 is 11025/(2^8 8!) = 1.1e-3 times 0.59^8 in the middle,
  // in s and in t; near the poles the columns lie closer.
  const Direction axis = glm::normalize(Direction(0.4, -0.2, 0.7));
  const Extent extent = {128, 64};
  Grid<Rgb> samples(extent);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const Direction centre = direction_from_square({(x + 0.5) / 128.0, (y + 0.5) / 64.0});
      samples(x, y) = Rgb(static_cast<float>(boost::math::legendre_p(12, glm::dot(axis, centre))));
    }
  }
  const RandomStream stream("SphereInterpolation", 1);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    SquarePoint at = stream.point(i);
    if (i % 4 == 0) at.t = 1.0 - 0.01 * at.t;  // beside the pole, across which rows go on
    if (i % 4 == 1) at.s *= 0.01;              // beside the seam
    const Direction direction = direction_from_square(at);
    const double exact = boost::math::legendre_p(12, std::min(1.0, glm::dot(axis, direction)));
    EXPECT_NEAR(interpolate_smooth(samples, direction).x, exact,
                2.0 * 1.1e-3 * std::pow(0.59, 8) + 1e-6)
        << at.s << " " << at.t;
  }
  for (const Direction pole : {Direction(0, 0, 1), Direction(0, 0, -1)}) {
    EXPECT_NEAR(interpolate_smooth(samples, pole).x,
                boost::math::legendre_p(12, glm::dot(axis, pole)), 4e-5);
  }
}

}  // namespace
}  // namespace lightproof
