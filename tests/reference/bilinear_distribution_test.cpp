#include "reference/bilinear_distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lightproof/core/error.h"
#include "lightproof/image/look_up.h"
#include "lightproof/image/synthetic.h"
#include "maps.h"
#include "reference/texel_masses.h"

namespace lightproof::reference {
namespace {

TargetDensity target_of(DensitySpace density_space) {
  return {density_space, kRec709, Lookup::bilinear};
}

Grid<double> masses_of(Extent extent, const std::vector<float>& values,
                       DensitySpace density_space = DensitySpace::texture) {
  return texel_masses(grey_map(extent, values), target_of(density_space));
}

// Sums of a few terms.
constexpr double kRounding = 1e-15;

TEST(BilinearDistribution, ATexelKeepsThreeQuartersInEachDirection) {
  const auto masses = masses_of({5, 5}, {0, 0, 0, 0, 0,  //
                                         0, 0, 0, 0, 0,  //
                                         0, 0, 1, 0, 0,  //
                                         0, 0, 0, 0, 0,  //
                                         0, 0, 0, 0, 0});
  const double share[] = {0.0, 0.125, 0.75, 0.125, 0.0};
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x) EXPECT_NEAR(masses(x, y), share[x] * share[y], kRounding);
  }
  EXPECT_EQ(masses(0, 2), 0.0);
  EXPECT_EQ(masses(2, 4), 0.0);
}

TEST(BilinearDistribution, WrapsAroundTheSeam) {
  const auto masses = masses_of({4, 1}, {1, 0, 0, 0});
  const double share[] = {0.75, 0.125, 0.0, 0.125};
  for (int x = 0; x < 4; ++x) EXPECT_NEAR(masses(x, 0), share[x], kRounding);
}

TEST(BilinearDistribution, IsClampedAtThePoles) {
  const auto masses = masses_of({1, 4}, {1, 0, 0, 0});
  const double share[] = {0.875, 0.125, 0.0, 0.0};
  for (int y = 0; y < 4; ++y) EXPECT_NEAR(masses(0, y), share[y], kRounding);
}

// ∫ of sin(pi t) up to 1/4, and of (3/2 - 2t) sin(pi t) from there to 1/2, over ∫ of both halves,
// which is 1/pi by symmetry. The rule's error is below 1e-14.
TEST(BilinearDistribution, TwoRowsUnderB) {
  const auto masses = masses_of({1, 2}, {1, 0}, DensitySpace::solid_angle);
  const double upper = 2.0 / kPi * (1.0 - std::sqrt(0.5));
  EXPECT_NEAR(masses(0, 0), 1.0 - upper, 1e-14);
  EXPECT_NEAR(masses(0, 1), upper, 1e-14);
}

// Not under C, which interpolates the solid angles of texels.
TEST(BilinearDistribution, OfAConstantMapIsThatOfWholeTexels) {
  for (const DensitySpace density_space : {DensitySpace::texture, DensitySpace::solid_angle}) {
    for (const Extent extent : kExtents) {
      const EnvironmentMap map = make_synthetic_map("constant", extent);
      const auto whole = texel_masses(map, {density_space});
      const auto tents = texel_masses(map, target_of(density_space));
      for (std::size_t i = 0; i < whole.values().size(); ++i) {
        EXPECT_NEAR(tents.values()[i], whole.values()[i], 1e-13 * whole.values()[i]);
      }
    }
  }
}

// A cell's mass by the middle rule over 64 x 64 points: in a quarter of a texel or less, cut at
// every centre and edge, its error is h^2/24 of the curvature, 1e-4 of sin(pi t) at most.
TEST(BilinearDistribution, CellsAreIntegralsOfTheLookUp) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {6, 4});
  for (const DensitySpace density_space : kDensitySpaces) {
    Grid<double> luminance = luminance_of(map);
    for (int y = 0; density_space == DensitySpace::sine_weighted && y < 4; ++y) {
      for (double& value : luminance.row(y)) value *= sin_theta((y + 0.5) / 4.0);
    }
    const Extent cells = {12, 8};
    const auto masses = bilinear_masses(map, target_of(density_space), cells);
    constexpr int kPoints = 64;
    Grid<double> sums(cells);
    double total = 0.0;
    for (int y = 0; y < cells.height * kPoints; ++y) {
      for (int x = 0; x < cells.width * kPoints; ++x) {
        const SquarePoint at = {(x + 0.5) / (cells.width * kPoints),
                                (y + 0.5) / (cells.height * kPoints)};
        const double weight = density_space == DensitySpace::solid_angle ? sin_theta(at.t) : 1.0;
        const double value = weight * look_up(luminance, Lookup::bilinear, at);
        sums(x / kPoints, y / kPoints) += value;
        total += value;
      }
    }
    for (std::size_t i = 0; i < sums.values().size(); ++i) {
      EXPECT_NEAR(masses.values()[i], sums.values()[i] / total, 1e-4 * masses.values()[i]) << i;
    }
  }
}

// However cells lie to texels, those of a finer grid add up.
TEST(BilinearDistribution, BinsAreSumsOfFinerBins) {
  for (const DensitySpace density_space : kDensitySpaces) {
    for (const Extent extent : kExtents) {
      const EnvironmentMap map = make_synthetic_map("gradient", extent);
      const auto coarse = bin_masses(map, target_of(density_space), {8, 4});
      const auto fine = bin_masses(map, target_of(density_space), {24, 12});
      Grid<double> sums({8, 4});
      for (int y = 0; y < 12; ++y) {
        for (int x = 0; x < 24; ++x) sums(x / 3, y / 3) += fine(x, y);
      }
      for (std::size_t i = 0; i < sums.values().size(); ++i) {
        EXPECT_NEAR(sums.values()[i], coarse.values()[i], 1e-14);
      }
    }
  }
}

TEST(BilinearDistribution, BlackMapIsRefused) {
  EXPECT_THROW(masses_of({2, 2}, {0, 0, 0, 0}), InputError);
}

// Sums of up to 2000 masses.
TEST(BilinearTransform, IsTheMassBelowAtTheTexelsEdges) {
  for (const char* name : {"sun-sky", "checker"}) {
    for (const DensitySpace density_space : kDensitySpaces) {
      for (const Extent extent : kExtents) {
        const EnvironmentMap map = make_synthetic_map(name, extent);
        const BilinearTransform transform(map, target_of(density_space));
        const auto masses = texel_masses(map, target_of(density_space));
        double below = 0.0;
        for (int y = 0; y < extent.height; ++y) {
          EXPECT_NEAR(transform({0.3, static_cast<double>(y) / extent.height}).marginal, below,
                      1e-13);
          below += row_marginal(masses)[static_cast<std::size_t>(y)];
        }
        double left = 0.0;
        for (int x = 0; x < extent.width; ++x) {
          EXPECT_NEAR(transform({static_cast<double>(x) / extent.width, 0.3}).column_marginal, left,
                      1e-13);
          left += column_marginal(masses)[static_cast<std::size_t>(x)];
        }
        EXPECT_NEAR(transform({0.3, 1.0}).marginal, 1.0, 1e-13);
        EXPECT_NEAR(transform({1.0, 0.3}).column_marginal, 1.0, 1e-13);
        EXPECT_NEAR(transform({1.0, 0.3}).conditional, 1.0, 1e-13);
      }
    }
  }
}

// At one t the look-up is linear between half texels: sums of its middles are exact.
TEST(BilinearTransform, ConditionalIsTheShareToTheLeftAtTheSameHeight) {
  const Extent extent = {7, 5};
  const EnvironmentMap map = make_synthetic_map("sun-sky", extent);
  const Grid<double> luminance = luminance_of(map);
  const BilinearTransform transform(map, target_of(DensitySpace::solid_angle));
  for (const double t : {0.02, 0.31, 0.5, 0.77, 0.98}) {
    double whole = 0.0;
    for (int i = 0; i < 14; ++i)
      whole += look_up(luminance, Lookup::bilinear, {(i + 0.5) / 14.0, t});
    double left = 0.0;
    for (int i = 0; i < 14; ++i) {
      EXPECT_NEAR(transform({i / 14.0, t}).conditional, left / whole, 1e-14);
      left += look_up(luminance, Lookup::bilinear, {(i + 0.5) / 14.0, t});
    }
  }
}

}  // namespace
}  // namespace lightproof::reference
