#include "lightproof/gate/discrete_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/gate/alternative_distribution.h"
#include "lightproof/gate/expectation.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/samplers/linear_scan.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

// CDF entries of 31 bits are 2^-31 off at most, and as many random numbers in 64 sums and 65536
// points fall in between with a probability of 3 %: up to two points may differ.
TEST(DiscreteSampler, DrawsTheTexelsOfTheDeclaredDistribution) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  for (const DensitySpace density_space : kDensitySpaces) {
    const TargetDensity target = {density_space, kRec709};
    const Expectation shares = expectation_of(map, target);
    const DiscreteSampler distribution(shares.masses, density_space);
    const LinearScan scan(map, target);
    const RandomStream stream("LawSampler", 1);
    int different = 0;
    for (std::uint64_t i = 0; i < 65536; ++i) {
      const TexelSample a = distribution.sample(stream.point(i));
      const TexelSample b = scan.sample(stream.point(i));
      if (a.x != b.x || a.y != b.y) {
        ++different;
        continue;
      }
      // A share of a table with n entries is up to n + 1 units of 2^-31 off: one unit is reserved
      // for every entry, and its two CDF entries are rounded.
      const double row = shares.rows[static_cast<std::size_t>(a.y)];
      const double texel = shares.masses(a.x, a.y) / row;
      const double error = 0x1p-31 * ((32 + 1) / row + (64 + 1) / texel);
      EXPECT_NEAR(b.pdf.value / a.pdf.value, 1.0, error);
      // Of the sine of a position that is rounded, near a pole.
      const double near = std::min(a.at.t, 1.0 - a.at.t);
      EXPECT_NEAR(distribution.pdf(a.at).value / a.pdf.value, 1.0, 1e-15 * (8.0 + 1.0 / near));
    }
    EXPECT_LE(different, 2);
  }
}

// Sizes around powers of two; cells without mass at the ends and between; all mass in one cell.
TEST(ShareGuide, FindsTheFirstCellWhoseSumLiesAbove) {
  const RandomStream stream("share guide", 1);
  for (const std::size_t cells : {1U, 2U, 3U, 7U, 8U, 9U, 100U}) {
    for (const double lit : {0.02, 0.5, 1.0}) {
      std::vector<double> sums(cells);
      double total = 0.0;
      for (std::size_t i = 0; i < cells; ++i) {
        const SquarePoint u = stream.point(i);
        total += u.s < lit || i == cells / 2 ? std::pow(u.t, 8.0) : 0.0;
        sums[i] = total;
      }
      for (double& sum : sums) sum /= total;
      const ShareGuide guide(sums);
      std::vector<double> points = {0.0, 0.5, 0x1.fffffffffffffp-1};
      for (std::uint64_t i = 0; i < 200; ++i) points.push_back(stream.point(1000 + i).s);
      for (const double sum : sums) {
        if (sum < 1.0) points.insert(points.end(), {sum, std::nextafter(sum, 0.0)});
      }
      for (const double u : points) {
        const auto above = std::upper_bound(sums.begin(), sums.end(), u);
        EXPECT_EQ(guide.find(sums, u), static_cast<std::size_t>(above - sums.begin()))
            << cells << " cells, u = " << u;
      }
    }
  }
}

TEST(AlternativeDistributions, SumToOneAndDifferFromTheDeclaredOne) {
  EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  // Colour, a texel without light, and rows around the absolute threshold.
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (x < 20) map.radiance(x, y) *= Rgb(2.0F, 0.7F, 0.3F);
      map.radiance(x, y) = Rgb(1e-5F * static_cast<float>(y)) + 1e-5F * map.radiance(x, y);
    }
  }
  map.radiance(30, 20) = Rgb(0.0F);
  for (const DensitySpace density_space : kDensitySpaces) {
    const TargetDensity target = {density_space, kRec709};
    const Grid<double> declared = reference::texel_masses(map, target);
    for (const AlternativeDistribution& distribution : alternative_distributions()) {
      const Grid<double> masses = distribution.masses({&declared, &map, target});
      double sum = 0.0;
      double distance = 0.0;
      for (std::size_t i = 0; i < masses.values().size(); ++i) {
        ASSERT_GE(masses.values()[i], 0.0) << distribution.name;
        sum += masses.values()[i];
        distance += std::abs(masses.values()[i] - declared.values()[i]);
      }
      EXPECT_NEAR(sum, 1.0, 1e-12) << distribution.name;
      EXPECT_GT(distance, 1e-8) << distribution.name;
    }
  }
}

}  // namespace
}  // namespace lightproof
