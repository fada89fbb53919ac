// The formulas of reference/ against sums over very many positions, in which nothing is clever.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "brute_force.h"
#include "maps.h"
#include "reference/bilinear_distribution.h"
#include "reference/bilinear_moments.h"
#include "reference/cosine_lobes.h"
#include "reference/estimator_moments.h"
#include "reference/rosenblatt_transform.h"
#include "reference/texel_masses.h"

namespace lightproof::reference {
namespace {

using test::kPi;

constexpr Extent kExtent = {5, 4};

/// Uneven, with a black texel and steep edges.
EnvironmentMap uneven_map() {
  return grey_map(kExtent, {1.0F, 4.0F, 0.5F,  2.0F, 3.0F,  //
                            0.0F, 1.0F, 6.0F,  2.0F, 1.0F,  //
                            2.0F, 0.3F, 1.0F,  5.0F, 3.0F,  //
                            1.0F, 1.0F, 0.75F, 4.0F, 0.5F});
}

/// 2^-24 of a weight is what a 32-bit texel may be off.
Grid<double> uneven_luminance() { return luminance_of(uneven_map()); }

/// What the density is in proportion to, over the square or over directions.
Grid<double> uneven_weights(DensitySpace density_space) {
  return density_space == DensitySpace::sine_weighted ? test::times_solid_angle(uneven_luminance())
                                                      : uneven_luminance();
}

/// Smooth on the upper hemisphere, and 0 on the lower one, with an edge on an edge of all cells.
KernelValue half_kernel(Direction d) {
  if (d.z < 0.0) return {0.0, 0.0};
  return {1.2 + 0.5 * d.x + 0.3 * d.y * d.z, (1.0 + 0.6 * d.y) / (2.0 * kPi)};
}

test::Factor half_factor(double x, double y, double z) {
  if (z < 0.0) return {0.0, 0.0};
  return {1.2 + 0.5 * x + 0.3 * y * z, (1.0 + 0.6 * y) / (2.0 * kPi)};
}

Kernel smooth_kernel() {
  return {half_kernel, [](Direction, double) { return false; }};
}

/// The midpoint rule is of second order: of twice as fine a lattice a third of the change is its
/// error, and the change itself three times that. No change is larger than 1e-3 of the value.
void expect_moments(const EstimatorMoments& exact, const test::EstimatorSums::RawMoments& coarse,
                    const test::EstimatorSums::RawMoments& fine) {
  for (std::size_t m = 0; m < 4; ++m) {
    const double change = std::abs(fine.raw[m] - coarse.raw[m]);
    ASSERT_LT(change, 1e-3 * fine.raw[m]);
    EXPECT_NEAR(exact.raw[m], fine.raw[m], change + 1e-8 * fine.raw[m]) << "moment " << m + 1;
  }
  // At nodes that are a hundredth of the sphere's size apart, of factors that change by half.
  EXPECT_NEAR(exact.largest, fine.largest, 0.02 * fine.largest);
}

void expect_estimators(const LightMoments& exact, test::Value value) {
  const Grid<double> luminance = uneven_luminance();
  // Whole numbers of cells for every half of a texel.
  const auto coarse = test::estimator_sums(luminance, value, half_factor, {320, 256});
  const auto fine = test::estimator_sums(luminance, value, half_factor, {640, 512});
  {
    SCOPED_TRACE("uniform");
    expect_moments(exact[SampledDensity::uniform], coarse.uniform, fine.uniform);
  }
  {
    SCOPED_TRACE("material");
    expect_moments(exact[SampledDensity::material], coarse.material, fine.material);
  }
  {
    SCOPED_TRACE("environment A");
    expect_moments(exact[SampledDensity::texture_space], coarse.environment_a, fine.environment_a);
  }
  {
    SCOPED_TRACE("environment B");
    expect_moments(exact[SampledDensity::solid_angle], coarse.environment_b, fine.environment_b);
  }
  {
    SCOPED_TRACE("environment C");
    expect_moments(exact[SampledDensity::sine_weighted], coarse.environment_c, fine.environment_c);
  }
}

TEST(LightMoments, AreThoseOfABruteSum) {
  const Grid<double> grids[] = {uneven_luminance()};
  expect_estimators(light_moments(smooth_kernel(), grids).front(), test::nearest_value);
}

TEST(BilinearMoments, AreThoseOfABruteSum) {
  expect_estimators(bilinear_light_moments(smooth_kernel(), uneven_luminance()),
                    test::interpolated_value);
}

/// E[1/p], E[1/p^2] and the largest 1/p where the texel's own value is 1 and more.
test::EstimatorSums::RawMoments inverse_pdf(DensitySpace density_space, Extent cells) {
  const Grid<double> luminance = uneven_luminance();
  const Grid<double> weights = uneven_weights(density_space);
  const bool over_directions = density_space == DensitySpace::solid_angle;
  double total = 0.0;
  test::visit_middles(cells, [&](double s, double t, double area) {
    const double jacobian = 2.0 * kPi * kPi * std::sin(kPi * t);
    total += test::interpolated_value(weights, s, t) * (over_directions ? jacobian : 1.0) * area;
  });
  test::EstimatorSums::RawMoments moments;
  test::visit_middles(cells, [&](double s, double t, double area) {
    if (test::nearest_value(luminance, s, t) < 0.9) return;
    const double jacobian = 2.0 * kPi * kPi * std::sin(kPi * t);
    const double light = test::interpolated_value(weights, s, t);
    const double pdf = light / total / (over_directions ? 1.0 : jacobian);
    moments.raw[0] += jacobian * area;
    moments.raw[1] += jacobian * area / pdf;
    moments.largest = std::max(moments.largest, 1.0 / pdf);
  });
  return moments;
}

TEST(BilinearInversePdf, IsThatOfABruteSum) {
  for (const DensitySpace density_space : kDensitySpaces) {
    const bool over_directions = density_space == DensitySpace::solid_angle;
    const auto coarse = inverse_pdf(density_space, {320, 256});
    const auto fine = inverse_pdf(density_space, {640, 512});
    const EstimatorMoments exact = bilinear_inverse_pdf(
        uneven_luminance(), density_space, [](double radiance) { return radiance >= 0.9; });
    for (std::size_t m = 0; m < 2; ++m) {
      const double change = std::abs(fine.raw[m] - coarse.raw[m]);
      ASSERT_LT(change, 1e-3 * fine.raw[m]);
      EXPECT_NEAR(exact.raw[m], fine.raw[m], change + 1e-7 * fine.raw[m]);
    }
    // A bound: of the darkest corner and the widest place of a texel, which need not be one.
    EXPECT_GE(exact.largest, fine.largest);
    EXPECT_LE(exact.largest, (over_directions ? 1.05 : 1.5) * fine.largest);
  }
}

/// Of a lattice with whole cells for every half of a texel and every bin.
Grid<double> sums_of_bins(const Grid<double>& masses, Extent bins) {
  Grid<double> sums(bins);
  const int across = masses.extent().width / bins.width;
  const int along = masses.extent().height / bins.height;
  for (int y = 0; y < masses.extent().height; ++y) {
    for (int x = 0; x < masses.extent().width; ++x) sums(x / across, y / along) += masses(x, y);
  }
  return sums;
}

/// Linear functions lose nothing in the midpoint rule. Under B the sine does, in cells of height
/// h = 1/384: (pi h)^2 / 24 of itself, and h^2/12 of the product of its slope, pi, and that of the
/// map, 6 in a quarter: 4e-5 of a mean above 1.
constexpr double kLattice = 1e-5;
constexpr double kLatticeOfMean = 4e-5;

TEST(BinMasses, AreThoseOfABruteSumHoweverBinsLie) {
  for (const DensitySpace density_space : kDensitySpaces) {
    for (const Lookup look_up : {Lookup::nearest, Lookup::bilinear}) {
      const auto value =
          look_up == Lookup::nearest ? test::nearest_value : test::interpolated_value;
      for (const Extent bins : {Extent{7, 6}, {3, 3}, {10, 16}}) {
        const Extent cells = {10 * bins.width, 384};
        const double mean = 1.0 / static_cast<double>(bins.count());
        const Grid<double> sums =
            sums_of_bins(test::lattice_masses(uneven_weights(density_space), value,
                                              density_space == DensitySpace::solid_angle, cells),
                         bins);
        const Grid<double> exact =
            bin_masses(uneven_map(), {density_space, kRec709, look_up}, bins);
        for (std::size_t i = 0; i < bins.count(); ++i) {
          EXPECT_NEAR(exact.values()[i], sums.values()[i],
                      kLattice * sums.values()[i] + kLatticeOfMean * mean)
              << i;
        }
      }
    }
  }
}

/// The mass below t, and the mass to the left of s.
struct CumulativeMasses {
  explicit CumulativeMasses(const Grid<double>& masses)
      : marginal(static_cast<std::size_t>(masses.extent().height) + 1),
        column_marginal(static_cast<std::size_t>(masses.extent().width) + 1) {
    for (int y = 0; y < masses.extent().height; ++y) {
      for (int x = 0; x < masses.extent().width; ++x) {
        marginal[static_cast<std::size_t>(y) + 1] += masses(x, y);
        column_marginal[static_cast<std::size_t>(x) + 1] += masses(x, y);
      }
    }
    for (std::size_t i = 1; i < marginal.size(); ++i) marginal[i] += marginal[i - 1];
    for (std::size_t i = 1; i < column_marginal.size(); ++i)
      column_marginal[i] += column_marginal[i - 1];
  }

  std::vector<double> marginal;
  std::vector<double> column_marginal;
};

/// The share of what lies left of s on the line at t, of a function without kinks between tenths.
double share_to_the_left(const Grid<double>& luminance, test::Value value, double s, double t) {
  constexpr int kParts = 640;
  double left = 0.0;
  double whole = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const double at = (i + 0.5) / kParts;
    whole += value(luminance, at, t);
    if (at < s) left += value(luminance, at, t);
  }
  return left / whole;
}

constexpr Extent kPositions = {20, 24};  ///< no edges of texels alone
constexpr Extent kLatticeOfPositions = {320, 384};

/// transform({s, t}) at all positions but the ends.
template <class Transform>
void expect_transform(test::Value value, DensitySpace density_space, const Transform& transform) {
  const Grid<double> luminance = uneven_weights(density_space);
  const CumulativeMasses below(test::lattice_masses(
      luminance, value, density_space == DensitySpace::solid_angle, kLatticeOfPositions));
  for (int j = 1; j < kPositions.height; ++j) {
    for (int i = 1; i < kPositions.width; ++i) {
      // Inside of a texel: its edges belong to either side.
      const SquarePoint at = {static_cast<double>(i) / kPositions.width,
                              static_cast<double>(j) / kPositions.height};
      const RosenblattPoint point = transform(at);
      const auto row = static_cast<std::size_t>(16 * j);
      const auto column = static_cast<std::size_t>(16 * i);
      EXPECT_NEAR(point.marginal, below.marginal[row], kLattice) << at.t;
      EXPECT_NEAR(point.column_marginal, below.column_marginal[column], kLattice) << at.s;
      if (j * kExtent.height % kPositions.height == 0) continue;  // two rows meet
      EXPECT_NEAR(point.conditional, share_to_the_left(luminance, value, at.s, at.t), 1e-12)
          << at.s << ", " << at.t;
    }
  }
}

TEST(RosenblattTransform, IsThatOfABruteSum) {
  for (const DensitySpace density_space : kDensitySpaces) {
    const RosenblattTransform transform(texel_masses(uneven_map(), {density_space}), density_space);
    expect_transform(test::nearest_value, density_space, [&](SquarePoint at) {
      return transform(at, static_cast<int>(at.s * kExtent.width),
                       static_cast<int>(at.t * kExtent.height));
    });
  }
}

TEST(BilinearTransform, IsThatOfABruteSum) {
  for (const DensitySpace density_space : kDensitySpaces) {
    const EnvironmentMap map = uneven_map();
    const BilinearTransform transform(map, {density_space, kRec709, Lookup::bilinear});
    expect_transform(test::interpolated_value, density_space, transform);
  }
}

// Every tent against the middles of 2^14 parts, (1/2^14)^2 / 24 of the curvature of x^2 times a
// slope of 5, and all of them together, which are 1 everywhere.
TEST(TentParts, AreIntegralsOfTents) {
  constexpr double kLow = 0.13;
  constexpr double kHigh = 0.77;
  constexpr int kParts = 1 << 14;
  for (const int texels : {1, 2, 5}) {
    for (const bool wraps : {false, true}) {
      SCOPED_TRACE(testing::Message() << texels << (wraps ? " in a circle" : " in a line"));
      std::vector<double> found(static_cast<std::size_t>(texels));
      for (const TentPart& part :
           tent_parts(kLow, kHigh, texels, wraps, [](double x) { return x * x; })) {
        found[static_cast<std::size_t>(part.texel)] += part.integral;
      }
      double sum = 0.0;
      for (int texel = 0; texel < texels; ++texel) {
        Grid<double> only(wraps ? Extent{texels, 1} : Extent{1, texels});
        only.values()[static_cast<std::size_t>(texel)] = 1.0;
        double expected = 0.0;
        for (int i = 0; i < kParts; ++i) {
          const double x = kLow + (i + 0.5) / kParts * (kHigh - kLow);
          expected += x * x * (kHigh - kLow) / kParts *
                      test::interpolated_value(only, wraps ? x : 0.5, wraps ? 0.5 : x);
        }
        EXPECT_NEAR(found[static_cast<std::size_t>(texel)], expected, 1e-8) << texel;
        sum += found[static_cast<std::size_t>(texel)];
      }
      EXPECT_NEAR(sum, (std::pow(kHigh, 3) - std::pow(kLow, 3)) / 3.0, 1e-14);
    }
  }
}

// Of a lobe the mass in a cone around it is 1 - cos^(n+1), wherever it points.
TEST(CosineLobes, HoldTheShareOfAnyConeAroundAnyAxis) {
  const double least = 0.8;
  for (const Direction axis : {Direction{0.6, 0.0, 0.8}, Direction{0.0, -1.0, 0.0}}) {
    for (const double exponent : {0.0, 1.0, 12.5}) {
      const CosineLobe lobes[] = {{axis, exponent, 1.0}};
      double inside = 0.0;
      test::visit_middles({1024, 512}, [&](double s, double t, double area) {
        const double theta = kPi - kPi * t;
        const double phi = kPi - 2.0 * kPi * s;
        const Direction d = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                             std::cos(theta)};
        if (glm::dot(d, axis) < least) return;
        inside += density(lobes, d) * 2.0 * kPi * kPi * std::sin(theta) * area;
      });
      // Cells on the edge of the cone are in or out: of the ring of 2 pi 0.6, at most half a cell's
      // diagonal pi / 512 wide on either side, few are wrong in one direction. A tenth of it.
      const double edge = 2.0 * kPi * 0.6 * kPi / 512.0 * (exponent + 1.0) / (2.0 * kPi) *
                          std::pow(least, exponent);
      EXPECT_NEAR(inside, 1.0 - std::pow(least, exponent + 1.0), 0.1 * edge);
    }
  }
}

// By quadrature, of which the closed form upside down is the sum: the share beyond an angle from
// -z is that beyond the same angle from +z. All rows are lit, but for the upper half.
TEST(CosineLobes, PointingDownAreThosePointingUpTurnedOver) {
  for (const double exponent : {1.0, 12.5}) {
    const CosineLobe lobes[] = {{{0.0, 0.0, -1.0}, exponent, 1.0}};
    const Extent cells = {8, 128};
    const Grid<double> masses = cell_masses(lobes, cells);
    for (int y = 0; y < cells.height; ++y) {
      const auto beyond = [&](int edge) {
        return std::pow(std::max(0.0, std::cos(kPi * edge / cells.height)), exponent + 1.0);
      };
      const double expected = (beyond(y) - beyond(y + 1)) / cells.width;
      // Gauss-Legendre of a power of 12 in cells of 1/41 of it: 1e-9.
      for (const double mass : masses.row(y)) EXPECT_NEAR(mass, expected, 1e-8) << y;
    }
  }
}

TEST(CosineLobes, TransformMixturesByTheirShares) {
  const CosineLobe lobes[] = {{{0.0, 0.0, 1.0}, 1.0, 0.25}, {{0.0, 0.0, 1.0}, 10.0, 0.75}};
  const RosenblattPoint at = rosenblatt_point(lobes, {0.3, 2.0 / 3.0});  // cos(theta) = 1/2
  EXPECT_NEAR(at.marginal, 0.25 * 0.25 + 0.75 * 0x1p-11, 1e-14);
  EXPECT_EQ(at.conditional, 0.3);
  EXPECT_EQ(at.column_marginal, 0.3);
  EXPECT_EQ(rosenblatt_point(lobes, {0.3, 0.4}).marginal, 0.0) << "below the horizon";
  EXPECT_EQ(rosenblatt_point(lobes, {0.3, 1.0}).marginal, 1.0);
}

}  // namespace
}  // namespace lightproof::reference
