#include "lightproof/samplers/bilinear.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/random.h"
#include "lightproof/image/look_up.h"
#include "lightproof/image/synthetic.h"
#include "reference/bilinear_distribution.h"

namespace lightproof {
namespace {

TargetDensity target_of(DensitySpace density_space) {
  return {density_space, kRec709, Lookup::bilinear};
}

EnvironmentMap grey_map(Extent extent, const std::vector<float>& values) {
  EnvironmentMap map{"grey", Grid<Rgb>(extent), {}};
  for (std::size_t i = 0; i < values.size(); ++i) map.radiance.values()[i] = Rgb(values[i]);
  return map;
}

Bilinear sampler_of(Extent extent, const std::vector<float>& values,
                    DensitySpace density_space = DensitySpace::texture) {
  return {grey_map(extent, values), target_of(density_space)};
}

// A mass of at least 1/12 is off by at most three units of 2^-31 in its row and in its column: a
// share of 3.4e-8; the luminance is a float: 6e-8, in the value and in the integral.
constexpr double kTableError = 4e-7;

TEST(Bilinear, TwoColumnsAreATentAroundTheCircle) {
  const Bilinear sampler = sampler_of({2, 1}, {1.0F, 3.0F});
  for (const double t : {0.01, 0.5, 0.99}) {
    EXPECT_NEAR(sampler.pdf({0.25, t}).value, 0.5, kTableError);
    EXPECT_NEAR(sampler.pdf({0.75, t}).value, 1.5, kTableError);
    EXPECT_NEAR(sampler.pdf({0.5, t}).value, 1.0, kTableError);
    EXPECT_NEAR(sampler.pdf({0.0, t}).value, 1.0, kTableError);
    EXPECT_NEAR(sampler.pdf({0.875, t}).value, 1.25, kTableError);
  }
}

TEST(Bilinear, TwoRowsAreConstantInTheHalvesAtThePoles) {
  const Bilinear sampler = sampler_of({1, 2}, {1.0F, 3.0F});
  for (const double s : {0.01, 0.5, 0.99}) {
    for (const double t : {0.0, 0.1, 0.249}) {
      EXPECT_NEAR(sampler.pdf({s, t}).value, 0.5, kTableError);
      EXPECT_NEAR(sampler.pdf({s, 1.0 - t}).value, 1.5, kTableError);
    }
    EXPECT_NEAR(sampler.pdf({s, 0.5}).value, 1.0, kTableError);
    EXPECT_NEAR(sampler.pdf({s, 0.625}).value, 1.25, kTableError);
  }
}

// The interpolation is odd about 2 and the sine is even: ∫ = 2 * 4 pi steradian.
TEST(Bilinear, TwoRowsUnderBAreInProportionPerSteradian) {
  const Bilinear sampler = sampler_of({1, 2}, {1.0F, 3.0F}, DensitySpace::solid_angle);
  const double expected[][2] = {{0.1, 1.0}, {0.5, 2.0}, {0.625, 2.5}, {0.9, 3.0}};
  for (const auto [t, luminance] : expected) {
    const PerSteradian pdf = to_solid_angle(sampler.pdf({0.3, t}), {0.3, t});
    EXPECT_NEAR(pdf.value, luminance / (8.0 * kPi), kTableError) << t;
  }
}

// The texel (1, 0): a tent of half width 1/3 in s, 1 up to t = 1/4, down to 0 at 3/4. ∫ = 1/6.
TEST(Bilinear, OneTexelOfThreeByTwoIsAProductOfTents) {
  const Bilinear sampler = sampler_of({3, 2}, {0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F});
  EXPECT_NEAR(sampler.pdf({0.5, 0.25}).value, 6.0, 6.0 * kTableError);
  EXPECT_NEAR(sampler.pdf({0.5, 0.1}).value, 6.0, 6.0 * kTableError);
  EXPECT_NEAR(sampler.pdf({0.5, 0.5}).value, 3.0, 6.0 * kTableError);
  EXPECT_NEAR(sampler.pdf({1.0 / 3.0, 0.1}).value, 3.0, 6.0 * kTableError);
  EXPECT_NEAR(sampler.pdf({0.25, 0.625}).value, 0.375, 6.0 * kTableError);
  EXPECT_EQ(sampler.pdf({0.1, 0.1}).value, 0.0);
  EXPECT_EQ(sampler.pdf({0.9, 0.1}).value, 0.0);
  EXPECT_EQ(sampler.pdf({0.5, 0.8}).value, 0.0);
}

// The first of three texels: a tent around s = 1/6 whose left end lies beyond the seam. An eighth
// of it.
TEST(Bilinear, ATentGoesOnBeyondTheSeam) {
  const Bilinear sampler = sampler_of({3, 1}, {1.0F, 0.0F, 0.0F});
  for (const double s : {0.0, 1.0 - 0x1p-40}) {
    EXPECT_NEAR(sampler.pdf({s, 0.5}).value, 1.5, 3.0 * kTableError);
  }
  EXPECT_NEAR(sampler.pdf({11.0 / 12.0, 0.5}).value, 0.75, 3.0 * kTableError);
  EXPECT_EQ(sampler.pdf({0.8, 0.5}).value, 0.0);
  EXPECT_LT(sampler.sample({0.875 - 1e-6, 0.5}).at.s, 0.5);
  const TexelSample beyond = sampler.sample({0.875 + 1e-6, 0.5});
  EXPECT_GT(beyond.at.s, 5.0 / 6.0);
  EXPECT_EQ(beyond.x, 2);
  EXPECT_LT(sampler.sample({0.0, 0.5}).at.s, 1e-9);
  EXPECT_GT(sampler.sample({1.0 - 0x1p-53, 0.5}).at.s, 1.0 - 1e-9);
}

// The last of three rows: constant from t = 5/6, half of the light.
TEST(Bilinear, TheHalfRowAtThePoleIsConstant) {
  const Bilinear sampler = sampler_of({1, 3}, {0.0F, 0.0F, 1.0F});
  EXPECT_NEAR(sampler.pdf({0.5, 0.999}).value, 3.0, 3.0 * kTableError);
  EXPECT_NEAR(sampler.pdf({0.5, 2.0 / 3.0}).value, 1.5, 3.0 * kTableError);
  EXPECT_NEAR(sampler.sample({0.5, 0.5}).at.t, 5.0 / 6.0, kTableError);
  EXPECT_NEAR(sampler.sample({0.5, 0.75}).at.t, 11.0 / 12.0, kTableError);
  // Below, the tent: a quarter of its mass lies in the lower half of its height.
  EXPECT_NEAR(sampler.sample({0.5, 0.125}).at.t, 2.0 / 3.0, kTableError);
}

TEST(Bilinear, OneTexelIsConstant) {
  const Bilinear a = sampler_of({1, 1}, {0.25F});
  const Bilinear b = sampler_of({1, 1}, {0.25F}, DensitySpace::solid_angle);
  for (const double u : {0.1, 0.5, 0.9}) {
    const TexelSample sample = a.sample({u, 1.0 - u});
    EXPECT_NEAR(sample.at.s, u, kTableError);
    EXPECT_NEAR(sample.at.t, 1.0 - u, kTableError);
    EXPECT_NEAR(sample.pdf.value, 1.0, kTableError);
    EXPECT_NEAR(cos_theta(b.sample({0.5, u}).at.t), 2.0 * u - 1.0, kTableError);
  }
}

TEST(Bilinear, BlackMapIsRefusedByName) {
  for (const float luminance : {0.0F, 1e-45F}) {  // 0.0722 of the least float is none
    EnvironmentMap map{"night", Grid<Rgb>({4, 2}), {}};
    map.radiance(1, 1) = Rgb(0.0F, 0.0F, luminance);
    try {
      const Bilinear sampler(map, target_of(DensitySpace::texture));
      FAIL() << "a black map was accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("night"), std::string::npos);
    }
  }
}

TEST(Bilinear, TheLargestFloatBesideTheSmallestStaysFinite) {
  for (const DensitySpace density_space : kDensitySpaces) {
    const Bilinear sampler =
        sampler_of({3, 2}, {3e38F, 1e-37F, 0.0F, 0.0F, 0.0F, 3e38F}, density_space);
    const RandomStream stream("extremes", 1);
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const TexelSample sample = sampler.sample(stream.point(i));
      ASSERT_TRUE(sample.pdf.value > 0.0 && std::isfinite(sample.pdf.value));
      ASSERT_EQ(sampler.pdf(sample.at).value, sample.pdf.value);
    }
  }
}

class BilinearOnMaps : public testing::TestWithParam<std::tuple<std::string_view, DensitySpace>> {
 protected:
  static constexpr Extent kSizes[] = {{1, 1}, {2, 1}, {1, 2}, {3, 2}, {31, 15}, {64, 32}};
};

/// ∫ of f over [low, high] inside [0,1]: for a linear function times sin(pi t) seven nodes leave
/// (7!)^4 / (15 (14!)^3) pi^14 = 4e-14 of a half period, and less of any smaller part.
template <class Function>
double integrate(double low, double high, const Function& f) {
  return boost::math::quadrature::gauss<double, 7>::integrate(f, low, high);
}

double patch_edge(int k, int texels) { return std::clamp((k - 0.5) / texels, 0.0, 1.0); }

/// A patch of the map, and what its cells of the table say.
struct Patch {
  double s[2];
  double t[2];
  CdfCell column;
  CdfCell row;

  double mass() const { return cdf_mass(row.units(), column.units()); }
};

CdfCell find(CdfEntries entries, double u) {
  int index = 0;
  while (entries[static_cast<std::size_t>(index) + 1] <= u * kCdfOne) ++index;
  const auto k = static_cast<std::size_t>(index);
  return {entries[k], entries[k + 1], index};
}

Patch patch_of(const Bilinear& sampler, SquarePoint u, Extent extent) {
  const CdfCell row = find(sampler.table().rows(), u.t);
  const CdfCell column = find(sampler.table().columns(row.index), u.s);
  return {{patch_edge(column.index, extent.width), patch_edge(column.index + 1, extent.width)},
          {patch_edge(row.index, extent.height), patch_edge(row.index + 1, extent.height)},
          column,
          row};
}

// The masses of the table sum to 1 exactly; sums of 1e5 terms round.
TEST_P(BilinearOnMaps, PdfIntegratesToOne) {
  const auto [name, density_space] = GetParam();
  for (const Extent extent : kSizes) {
    const Bilinear sampler(make_synthetic_map(name, extent), target_of(density_space));
    double sum = 0.0;
    for (int r = 0; r <= extent.height; ++r) {
      sum +=
          integrate(patch_edge(r, extent.height), patch_edge(r + 1, extent.height), [&](double t) {
            double line = 0.0;
            for (int k = 0; k <= extent.width; ++k) {
              // Linear in s: the middle is exact.
              const double low = patch_edge(k, extent.width);
              const double high = patch_edge(k + 1, extent.width);
              line += (high - low) * sampler.pdf({0.5 * (low + high), t}).value;
            }
            return line;
          });
    }
    EXPECT_NEAR(sum, 1.0, 1e-12) << extent.width << "x" << extent.height;
  }
}

// The table rounds the mass of a patch: its two CDF entries in each of two distributions are off by
// less than a unit for rounding and one for every cell with light. Inside the patch the luminance
// is a float; under C it is that of the centres, times the sine there, that is interpolated.
TEST_P(BilinearOnMaps, PdfIsTheInterpolatedLuminanceOverItsIntegral) {
  const std::string_view name = std::get<0>(GetParam());
  const DensitySpace density_space = std::get<1>(GetParam());
  for (const Extent extent : kSizes) {
    const EnvironmentMap map = make_synthetic_map(name, extent);
    const Bilinear sampler(map, target_of(density_space));
    Grid<double> luminance = luminance_of(map);
    for (int y = 0; density_space == DensitySpace::sine_weighted && y < extent.height; ++y) {
      for (double& value : luminance.row(y)) value *= sin_theta((y + 0.5) / extent.height);
    }
    const Grid<double> quarters = reference::bilinear_masses(map, target_of(density_space),
                                                             {2 * extent.width, 2 * extent.height});
    const double mass_error = 2.0 * (extent.height + extent.width + 6) * 0x1p-31;
    const auto density = [&](SquarePoint at) {
      const double value = look_up(luminance, Lookup::bilinear, at);
      return position_measure(density_space) == MapMeasure::square
                 ? value
                 : value * solid_angle_per_square(at.t);
    };
    double total = 0.0;
    for (int i = 0; i < 2 * extent.height; ++i) {
      total += integrate(i / (2.0 * extent.height), (i + 1) / (2.0 * extent.height), [&](double t) {
        double line = 0.0;
        for (int k = 0; k < 2 * extent.width; ++k) {
          line += density({(k + 0.5) / (2.0 * extent.width), t}) / (2.0 * extent.width);
        }
        return line;
      });
    }
    const RandomStream stream("pdf", 1);
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const SquarePoint at = stream.point(i);
      const double exact = density(at) / total;
      const int column = static_cast<int>(std::round(at.s * extent.width));
      const int row = static_cast<int>(std::round(at.t * extent.height));
      double mass = 0.0;
      for (int y = std::max(0, 2 * row - 1); y <= std::min(2 * row, 2 * extent.height - 1); ++y) {
        for (int x = std::max(0, 2 * column - 1); x <= std::min(2 * column, 2 * extent.width - 1);
             ++x) {
          mass += quarters(x, y);
        }
      }
      const double error = mass > 0.0 ? mass_error / mass + 2.0 * 0x1p-24 : 0.0;
      ASSERT_NEAR(sampler.pdf(at).value, exact, error * exact) << at.s << ", " << at.t;
    }
  }
}

// What is drawn is what pdf() says: of a patch, the share of the random number along lies below t;
// at that t, the share across lies to the left of s. Both are kept 2^-36 of the patch away from its
// edges, where the density is at most twice the mean in s, and 4 times (with the sine) in t.
TEST_P(BilinearOnMaps, TheDensityDrawnIsThePdf) {
  const auto [name, density_space] = GetParam();
  constexpr double kTolerance = 4.0 * kCellMargin + 1e-12;
  for (const Extent extent : kSizes) {
    const Bilinear sampler(make_synthetic_map(name, extent), target_of(density_space));
    const RandomStream stream("drawn", 1);
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const SquarePoint u = stream.point(i);
      const Patch patch = patch_of(sampler, u, extent);
      const SquarePoint at = sampler.sample(u).at;
      ASSERT_TRUE(at.s > patch.s[0] && at.s < patch.s[1] && at.t > patch.t[0] && at.t < patch.t[1]);
      // Linear in s: the middle is exact.
      const auto across = [&](double s, double t) {
        return (s - patch.s[0]) * sampler.pdf({0.5 * (patch.s[0] + s), t}).value;
      };
      const double below =
          integrate(patch.t[0], at.t, [&](double t) { return across(patch.s[1], t); });
      ASSERT_NEAR(below / patch.mass(), patch.row.fraction(u.t * kCdfOne), kTolerance);
      ASSERT_NEAR(across(at.s, at.t) / across(patch.s[1], at.t),
                  patch.column.fraction(u.s * kCdfOne), kTolerance);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, BilinearOnMaps,
                         testing::Combine(testing::Values("constant", "one-texel", "gradient",
                                                          "cosine-lobe", "step", "sun-sky",
                                                          "checker", "black-first-row"),
                                          testing::ValuesIn(kDensitySpaces)));

}  // namespace
}  // namespace lightproof
