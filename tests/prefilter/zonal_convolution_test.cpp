#include "lightproof/prefilter/zonal_convolution.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <string>

#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// The filter that keeps one degree.
std::vector<double> degree_alone(int degree) {
  std::vector<double> factors(static_cast<std::size_t>(degree) + 1, 0.0);
  factors.back() = 1.0;
  return factors;
}

Direction centre_of(Extent extent, int x, int y) {
  return direction_from_square({(x + 0.5) / extent.width, (y + 0.5) / extent.height});
}

Grid<Rgb> noise(Extent extent) {
  const RandomStream stream("ZonalConvolution.noise", 1);
  Grid<Rgb> map(extent);
  for (std::size_t i = 0; i < map.values().size(); ++i) {
    const SquarePoint u = stream.point(i);
    map.values()[i] = Rgb(u.s, u.t, u.s * u.t);
  }
  return map;
}

/// The integral of the directions of a texel, in closed form.
Direction texel_moment(Extent extent, int x, int y) {
  const double low = kPi * y / extent.height;  // from the nadir
  const double high = kPi * (y + 1.0) / extent.height;
  const auto phi = [&](double column) { return kPi - 2.0 * kPi * column / extent.width; };
  const double sines = 0.5 * (high - low) - 0.25 * (std::sin(2.0 * high) - std::sin(2.0 * low));
  const double from = phi(x + 1.0);
  const double to = phi(x);
  // z = -cos of the angle from the nadir.
  const double along = -0.5 * (std::sin(high) * std::sin(high) - std::sin(low) * std::sin(low));
  return {sines * (std::sin(to) - std::sin(from)), sines * (std::cos(from) - std::cos(to)),
          along * (to - from)};
}

class ConvolvedSizes : public testing::TestWithParam<Extent> {};

TEST_P(ConvolvedSizes, DegreeZeroIsTheMean) {
  const Extent extent = GetParam();
  const Grid<Rgb> map = noise(extent);
  glm::dvec3 mean(0.0);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      mean += texel_solid_angle(extent, y) / kSphere * glm::dvec3(map(x, y));
    }
  }
  const ZonalFilter filter = {degree_alone(0), {5, 3}};
  const Grid<Rgb> result = std::move(convolve(map, {&filter, 1}).front());
  for (const Rgb value : result.values()) {
    // Values of at most 1 as floats.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], mean[c], 0x1p-24 + 1e-12);
  }
}

TEST_P(ConvolvedSizes, DegreeOneIsTheMomentOfTheLight) {
  const Extent extent = GetParam();
  const Grid<Rgb> map = noise(extent);
  glm::dmat3 moments(0.0);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      moments += glm::outerProduct(texel_moment(extent, x, y), glm::dvec3(map(x, y)));
    }
  }
  const Extent out = {8, 5};
  const ZonalFilter filter = {degree_alone(1), out};
  const Grid<Rgb> result = std::move(convolve(map, {&filter, 1}).front());
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      // (2l+1)/4pi times the integral of L P_1.
      const glm::dvec3 exact = 3.0 / kSphere * (centre_of(out, x, y) * moments);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(result(x, y)[c], exact[c], 0x1p-24 + 1e-12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfAllSorts, ConvolvedSizes,
                         testing::Values(Extent{1, 1}, Extent{1, 7}, Extent{3, 2}, Extent{2, 1},
                                         Extent{16, 8}, Extent{13, 11}, Extent{100, 75},
                                         Extent{31, 300}, Extent{257, 64}),
                         [](const auto& tested) {
                           return std::to_string(tested.param.width) + "x" +
                                  std::to_string(tested.param.height);
                         });

/// (2l+1)/4pi times the integral of P_l of the cosine to `axis` over a texel, by Gauss-Legendre
/// nodes in parts that are narrow against the waves.
double texel_legendre(Extent extent, int x, int y, int degree, Direction axis) {
  using Gauss = boost::math::quadrature::gauss<double, 15>;
  // Fifteen nodes are exact to rounding over twelve radians of phase.
  const int parts =
      1 + static_cast<int>(degree * kPi / std::min(extent.width / 2, extent.height) / 12.0);
  const auto over_parts = [parts](int index, int count, const auto& f) {
    double sum = 0.0;
    for (int i = 0; i < parts; ++i) {
      const double step = 1.0 / (static_cast<double>(count) * parts);
      const double low = static_cast<double>(index) / count + i * step;
      sum += Gauss::integrate(f, low, low + step);
    }
    return sum;
  };
  return (2.0 * degree + 1.0) / kSphere * over_parts(y, extent.height, [&](double t) {
           return solid_angle_per_square(t) * over_parts(x, extent.width, [&](double s) {
                    const double cosine = glm::dot(direction_from_square({s, t}), axis);
                    return std::legendre(static_cast<unsigned>(degree),
                                         std::clamp(cosine, -1.0, 1.0));
                  });
         });
}

struct LitTexel {
  Extent extent;
  int x;
  int y;
};

// At a pole, at the seam, on the equator; and where functions of high order are smallest.
constexpr LitTexel kLit[] = {
    {{64, 32}, 0, 31}, {{64, 32}, 63, 9}, {{48, 31}, 20, 15}, {{64, 32}, 17, 0}};

TEST(Convolve, GivesEveryDegreeOfOneLitTexel) {
  const Extent out = {10, 6};
  for (const LitTexel& lit : kLit) {
    Grid<Rgb> map(lit.extent);
    map(lit.x, lit.y) = Rgb(1.0F, 0.0F, 0.5F);
    for (const int degree : {2, 17, 400, kLargestDegree}) {
      const ZonalFilter filter = {degree_alone(degree), out};
      const Grid<Rgb> result = std::move(convolve(map, {&filter, 1}).front());
      for (int y = 0; y < out.height; y += 3) {
        for (int x = 0; x < out.width; x += 5) {
          const double exact =
              texel_legendre(lit.extent, lit.x, lit.y, degree, centre_of(out, x, y));
          // Roundings of up to 1800 steps of both recursions, on values of at most (2l+1)/4pi
          // times the texel's area.
          const double largest =
              (2.0 * degree + 1.0) / kSphere * texel_solid_angle(lit.extent, lit.y);
          const double roundings = 1e-12 * degree * largest + 0x1p-24 * std::abs(exact);
          EXPECT_NEAR(result(x, y).r, exact, roundings)
              << "degree " << degree << ", texel " << lit.x << ", " << lit.y << " at " << x << ", "
              << y;
          EXPECT_EQ(result(x, y).g, 0.0F);
          EXPECT_NEAR(result(x, y).b, 0.5 * exact, roundings);
        }
      }
    }
  }
}

TEST(Convolve, TurnsWithTheMap) {
  const Extent extent = {48, 20};
  const Grid<Rgb> map = noise(extent);
  Grid<Rgb> turned(extent);
  constexpr int kColumns = 9;
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      turned((x + kColumns) % extent.width, y) = map(x, y);
    }
  }
  const ZonalFilter filter = {std::vector<double>(40, 1.0), {16, 9}};
  const Grid<Rgb> of_map = std::move(convolve(map, {&filter, 1}).front());
  const Grid<Rgb> of_turned = std::move(convolve(turned, {&filter, 1}).front());
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 16; ++x) {
      // Three columns of the output; two floats near 1.
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(of_turned((x + 3) % 16, y)[c], of_map(x, y)[c], 3e-7);
    }
  }
}

TEST(Convolve, ServesSeveralFiltersAsEachAlone) {
  const Grid<Rgb> map = noise({40, 20});
  const ZonalFilter filters[] = {{std::vector<double>(30, 0.5), {16, 8}},
                                 {degree_alone(3), {5, 1}},
                                 {std::vector<double>(90, 1.0), {7, 30}}};
  const std::vector<Grid<Rgb>> together = convolve(map, filters);
  for (std::size_t i = 0; i < 3; ++i) {
    const Grid<Rgb> alone = std::move(convolve(map, {&filters[i], 1}).front());
    ASSERT_EQ(together[i].extent(), filters[i].extent);
    for (std::size_t k = 0; k < alone.values().size(); ++k) {
      EXPECT_EQ(together[i].values()[k], alone.values()[k]);
    }
  }
}

TEST(Convolve, HasTheSameBitsOnAnyNumberOfThreads) {
  const Grid<Rgb> map = noise({100, 50});
  const ZonalFilter filter = {std::vector<double>(200, 1.0), {64, 32}};
  const Grid<Rgb> many = std::move(convolve(map, {&filter, 1}).front());
  const ThreadLimit limit(1);
  const Grid<Rgb> one = std::move(convolve(map, {&filter, 1}).front());
  for (std::size_t i = 0; i < one.values().size(); ++i) {
    ASSERT_EQ(one.values()[i], many.values()[i]);
  }
}

}  // namespace
}  // namespace lightproof
