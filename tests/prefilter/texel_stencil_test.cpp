#include "lightproof/prefilter/texel_stencil.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

double cosine_of(double haversine) { return 1.0 - 2.0 * haversine; }

Grid<Rgb> noise(Extent extent) {
  const RandomStream stream("TexelStencil.noise", 1);
  Grid<Rgb> map(extent);
  for (std::size_t i = 0; i < map.values().size(); ++i) {
    map.values()[i] = Rgb(static_cast<float>(stream.point(i).s));
  }
  return map;
}

/// 1 within 0.4 radians of the axis.
ZonalKernel disc() {
  return {[](double) { return 1.0; }, {1.0}, {0.4}, true};
}

/// Smooth, and 0 from 0.5 radians on.
ZonalKernel bump() {
  return {[](double haversine) {
            const double rest = std::max(0.0, cosine_of(haversine) - std::cos(0.5));
            return rest * rest;
          },
          {0.2},
          {0.5},
          false};
}

TEST(LocalSums, OfAWhiteMapAreTheWhole) {
  const Grid<Rgb> map({30, 15}, Rgb(1.0F));
  for (const ZonalKernel& kernel : {disc(), bump()}) {
    const Grid<glm::dvec3> sums = local_sums(map, kernel, 0.75, {9, 5});
    for (const glm::dvec3 value : sums.values()) EXPECT_NEAR(value.x, 0.75, 1e-13);
  }
}

TEST(LocalSums, OfAGridAreThoseOfItsDirections) {
  // Column centres at one place of a texel, at three, and at seven; and over a pole.
  const Grid<Rgb> map = noise({30, 15});
  for (const Extent out : {Extent{10, 5}, Extent{9, 4}, Extent{7, 15}}) {
    for (const ZonalKernel& kernel : {disc(), bump()}) {
      const Grid<glm::dvec3> sums = local_sums(map, kernel, 1.0, out);
      for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
          const Direction axis =
              direction_from_square({(x + 0.5) / out.width, (y + 0.5) / out.height});
          // Roundings of the axis, beside cells that one of them divides: of an edge that is cut to
          // a straight line in cells of at most 0.02, a thousandth.
          EXPECT_NEAR(sums(x, y).x, local_sum(map, kernel, 1.0, axis).x, 1e-3);
        }
      }
    }
  }
}

// A disc around the pole: the rows' shares of it follow from their edges. Row 15 and row 14 are
// within its 0.4 radians, row 13 is cut after 0.0073 of 0.196.
TEST(LocalSums, CutTexelsAtTheKernelsEdge) {
  const Direction pole = {0.0, 0.0, 1.0};
  const auto share = [&](int row) {
    Grid<Rgb> map({16, 16});
    for (int x = 0; x < 16; ++x) map(x, row) = Rgb(1.0F);
    return local_sum(map, disc(), 1.0, pole).x;
  };
  const auto cap = [](double angle) { return 1.0 - std::cos(angle); };
  const double cut = (cap(0.4) - cap(kPi / 8.0)) / cap(0.4);
  // A cell that is cut has the solid angle of its middle, less than 0.01 radians off the part's.
  const double tolerance = 0.01 / 0.4 * cut;
  EXPECT_NEAR(share(13), cut, tolerance);
  EXPECT_NEAR(share(14), (cap(kPi / 8.0) - cap(kPi / 16.0)) / cap(0.4), tolerance);
  EXPECT_NEAR(share(15), cap(kPi / 16.0) / cap(0.4), tolerance);
  EXPECT_EQ(share(12), 0.0);
}

// Half of the sphere: its edge crosses every column.
TEST(LocalSums, OfAHemisphereHaveTheMeanOfALinearMap) {
  const Extent extent = {128, 64};
  Grid<Rgb> map(extent);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const Direction centre = direction_from_square({(x + 0.5) / 128.0, (y + 0.5) / 64.0});
      map(x, y) = Rgb(static_cast<float>(1.0 + centre.x));
    }
  }
  const ZonalKernel hemisphere = {[](double) { return 1.0; }, {1.0}, {0.5 * kPi}, true};
  for (const Direction axis : {Direction(1.0, 0.0, 0.0), Direction(0.0, 0.6, 0.8),
                               glm::normalize(Direction(0.5, 0.2, -0.7))}) {
    // The mean of a direction over the hemisphere is half of the axis; a texel's value stands for
    // all of it, which is off by h^2/6 of the linear part on average.
    EXPECT_NEAR(local_sum(map, hemisphere, 1.0, axis).x, 1.0 + 0.5 * axis.x,
                std::pow(kPi / 64.0, 2) / 6.0);
  }
}

TEST(TexelStencil, OfALargeMapStopsWithinATenthOfItsWork) {
  int calls = 0;
  int stop_at = -1;
  const ZonalKernel kernel = {[&](double) {
                                if (calls++ == stop_at) request_interrupt();
                                return 1.0;
                              },
                              {1.0},
                              {1.5},
                              true};
  const auto make = [&] { return TexelStencil(kernel, {256, 128}, {0.001, 0.5}, 1.0); };
  make();
  const int all = calls;
  calls = 0;
  stop_at = all / 4;
  EXPECT_THROW(make(), Interrupted);
  withdraw_interrupt();
  EXPECT_LE(calls, stop_at + all / 10);
}

}  // namespace
}  // namespace lightproof
