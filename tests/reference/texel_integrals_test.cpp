#include "reference/texel_integrals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/core/error.h"
#include "lightproof/core/measure.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"
#include "lightproof/warp/lat_long.h"
#include "reference/cosine_lobes.h"

namespace lightproof::reference {
namespace {

double sum_of(const Grid<double>& values) {
  double sum = 0.0;
  for (const double value : values.values()) sum += value;
  return sum;
}

PeakedDensity around(const Lobe& lobe, Direction axis) {
  return {[lobe, axis](Direction light) { return lobe.value(light, axis); }, axis, lobe.width, axis,
          lobe.jumps};
}

const Direction kAxes[] = {
    {0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}, glm::normalize(Direction(0.3, -0.5, -0.4))};

TEST(TexelIntegrals, AddUpToTheIntegralInClosedForm) {
  for (const Direction axis : kAxes) {
    for (const Extent extent : {Extent{1, 1}, Extent{3, 2}, Extent{40, 20}}) {
      for (const double exponent : {1.0, 20.0, 3000.0}) {
        const double exact = 2.0 * kPi / (exponent + 1.0);
        EXPECT_NEAR(sum_of(texel_integrals(around(phong_lobe(exponent), axis), extent)), exact,
                    1e-5 * exact);
      }
      // The half-vector lobe of exponent 2: the integral of (1 + c)/2 over c in [0,1] and phi.
      EXPECT_NEAR(sum_of(texel_integrals(around(half_vector_lobe(2.0), axis), extent)),
                  2.0 * kPi * 0.75, 1e-3)
          << "the jump at the horizon is cut to 1e-3";
      // D cos over the directions of light, of alpha = 1: cos/pi, whose integral is 1.
      EXPECT_NEAR(sum_of(texel_integrals(around(ggx_lobe(1.0), axis), extent)), 1.0, 1e-5);
      // G1 = 2c/(c + 1) of alpha = 1: 2 (2 c/(c+1)) over c: 4 (1 - ln 2).
      EXPECT_NEAR(sum_of(texel_integrals(around(ggx_masked_lobe(1.0, 1.0), axis), extent)),
                  4.0 * (1.0 - std::log(2.0)), 1e-5);
    }
  }
}

TEST(TexelIntegrals, AreThoseOfCosineLobes) {
  const Direction axis = kAxes[2];
  const CosineLobe lobe = {axis, 30.0, 1.0};
  const Extent extent = {64, 32};
  const Grid<double> masses = cell_masses({&lobe, 1}, extent);
  const Grid<double> integrals = texel_integrals(around(phong_lobe(30.0), axis), extent);
  for (std::size_t i = 0; i < masses.values().size(); ++i) {
    EXPECT_NEAR(integrals.values()[i] * 31.0 / (2.0 * kPi), masses.values()[i],
                2e-5 * masses.values()[i] + 1e-9);
  }
}

TEST(TexelIntegrals, OfANarrowLobeStayInItsTexel) {
  // A hundredth of a texel wide, in the middle of one.
  const Extent extent = {16, 8};
  const Direction axis = direction_from_square({5.5 / 16, 3.5 / 8});
  const Grid<double> integrals = texel_integrals(around(phong_lobe(1e5), axis), extent);
  EXPECT_NEAR(integrals(5, 3) * 100001.0 / (2.0 * kPi), 1.0, 1e-5);
}

TEST(Prefiltered, LevelIsEachDirectionsOwn) {
  const RandomStream stream("Prefiltered.map", 1);
  const Extent extent = {24, 12};
  Grid<Rgb> map(extent);
  for (std::size_t i = 0; i < map.values().size(); ++i) {
    const SquarePoint u = stream.point(i);
    map.values()[i] = Rgb(u.s, u.t, 1.0);
  }
  for (const Extent out : {Extent{8, 4}, Extent{24, 3}, Extent{7, 5}}) {
    const Lobe lobe = ggx_lobe(0.2);
    const Grid<glm::dvec3> level = prefiltered(map, lobe, out);
    for (int y = 0; y < out.height; ++y) {
      for (int x = 0; x < out.width; ++x) {
        const Direction axis =
            direction_from_square({(x + 0.5) / out.width, (y + 0.5) / out.height});
        const glm::dvec3 alone = prefiltered(map, lobe, axis);
        // The same cells, from another side of the sphere: roundings decide which are divided.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(level(x, y)[c], alone[c], 1e-5);
        EXPECT_NEAR(level(x, y).z, 1.0, 1e-12);
      }
    }
  }
}

TEST(Reflected, OfAWhiteMapIsTheReflectance) {
  const Grid<Rgb> map({20, 10}, Rgb(1.0F));
  for (const Direction normal : kAxes) {
    const PeakedDensity lambert = {
        [&](Direction light) { return 0.7 / kPi * std::max(0.0, glm::dot(light, normal)); }, normal,
        1.0, normal, false};
    EXPECT_NEAR(reflected(map, lambert).x, 0.7, 1e-5);
  }
}

TEST(TexelIntegrals, OfALargeMapStopWithinAQuarterOfTheirWork) {
  const ThreadLimit limit(1);
  int calls = 0;
  int stop_at = -1;
  const PeakedDensity density = {[&](Direction) {
                                   if (calls++ == stop_at) request_interrupt();
                                   return 1.0;
                                 },
                                 {0.0, 0.0, 1.0},
                                 3.0,
                                 {0.0, 0.0, 1.0},
                                 false};
  const auto integrate = [&] { return texel_integrals(density, {1024, 512}); };
  integrate();
  const int all = calls;
  calls = 0;
  stop_at = all / 4;
  EXPECT_THROW(integrate(), Interrupted);
  withdraw_interrupt();
  EXPECT_LE(calls, stop_at + all / 4);
}

}  // namespace
}  // namespace lightproof::reference
