// Kuiper and Anderson-Darling see counts of cells only. With many samples in each cell their
// p-values are those of the coordinates themselves all the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"
#include "lightproof/core/random_batch.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/stats/uniformity.h"

namespace lightproof {
namespace {

constexpr std::size_t kReplicates = 2000;
constexpr std::uint64_t kSamples = 16 * kUniformCells / 2;  // two coordinates a point
constexpr std::uint64_t kBatch = 1024;
static_assert(kSamples % kBatch == 0);

/// Largest distance of the distribution of the p-values from uniform.
double distance_from_uniform(std::vector<double> p_values) {
  std::sort(p_values.begin(), p_values.end());
  const auto n = static_cast<double>(p_values.size());
  double distance = 0.0;
  for (std::size_t i = 0; i < p_values.size(); ++i) {
    const auto rank = static_cast<double>(i);
    distance = std::max({distance, (rank + 1.0) / n - p_values[i], p_values[i] - rank / n});
  }
  return distance;
}

TEST(Uniformity, HasUniformPValuesWithManySamplesInEachCell) {
  std::vector<double> kuiper(kReplicates);
  std::vector<double> anderson(kReplicates);
  parallel_for(kReplicates, [&](std::size_t i) {
    const RandomStream stream("many samples in each cell", 1, i);
    std::vector<std::uint64_t> counts(kUniformCells);
    std::vector<SquarePoint> points(kBatch);
    for (std::uint64_t first = 0; first < kSamples; first += kBatch) {
      fill_points(stream, first, points);
      for (const SquarePoint u : points) {
        ++counts[static_cast<std::size_t>(cell_of(u.s, static_cast<int>(kUniformCells)))];
        ++counts[static_cast<std::size_t>(cell_of(u.t, static_cast<int>(kUniformCells)))];
      }
    }
    kuiper[i] = std::pow(10.0, kuiper_test(counts).log10_p);
    anderson[i] = std::pow(10.0, anderson_darling_test(counts).log10_p);
  });
  // Dvoretzky, Kiefer, Wolfowitz, Massart: exceeded with a probability of 1e-6.
  const double bound = std::sqrt(std::log(2.0 / 1e-6) / (2.0 * kReplicates));
  EXPECT_LT(distance_from_uniform(kuiper), bound);
  EXPECT_LT(distance_from_uniform(anderson), bound);
}

}  // namespace
}  // namespace lightproof
