#include "lightproof/gate/expectation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lightproof/core/random.h"
#include "lightproof/gate/sampler_under_test.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

// The bound behind the p-values of means holds only if no sample's value is beyond the largest one:
// in the row of a pole 1/pdf at the edge is nearly twice that at the row's centre.
TEST(Expectation, NoInversePdfIsBeyondTheLargest) {
  for (const int height : {1, 2, 3, 8}) {
    for (const int lit : {0, height / 2, height - 1}) {
      EnvironmentMap map = {"one row", Grid<Rgb>({2 * height, height}), {}};
      for (int x = 0; x < 2 * height; ++x) map.radiance(x, lit) = Rgb(1.0F);
      for (const DensitySpace density_space : kDensitySpaces) {
        const SamplerUnderTest under_test =
            sampler_under_test(sampler_by_name("binary_search"), density_space);
        const Expectation expectation = expectation_of(map, under_test.target);
        const BoundSampler sampler = under_test.bind(map);
        const RandomStream stream("largest inverse pdf", 1);
        double largest = 0.0;
        for (std::uint64_t i = 0; i < 4096; ++i) {
          const SquarePoint point = stream.point(i);
          TexelSample sample{};
          sampler.sample({&point, 1}, {&sample, 1});
          largest = std::max(largest, 1.0 / to_solid_angle(sample.pdf, sample.at).value);
        }
        const double bound = expectation.inverse_pdf.largest;
        // The sampler's sums are whole numbers of 2^-31: a texel's mass, 2^-7 at the least, is off
        // by 2^-23 of itself at the most.
        EXPECT_LE(largest, bound * (1.0 + 0x1p-23)) << height << " rows, row " << lit;
        // Of 4096 samples one lies within a hundredth of a row's height from the edge.
        EXPECT_GE(largest, 0.95 * bound) << height << " rows, row " << lit;
      }
    }
  }
}

}  // namespace
}  // namespace lightproof
