// How often a test rejects samples of a distribution that it should find, and what that number may
// be.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lightproof/core/random.h"

namespace lightproof {

/// A correct program fails one of these limits once in ten million runs.
inline constexpr double kChanceOfFailure = 1e-7;

/// Fails if so many rejections are too few for a test whose power is at least this.
inline void expect_power_at_least(double power, int rejected, int replicates) {
  const boost::math::binomial rejections(replicates, power);
  EXPECT_GE(rejected, boost::math::quantile(rejections, kChanceOfFailure));
}

/// Fails if they are too many for a test whose power is at most this.
inline void expect_power_at_most(double power, int rejected, int replicates) {
  const boost::math::binomial rejections(replicates, power);
  EXPECT_LE(rejected, boost::math::quantile(boost::math::complement(rejections, kChanceOfFailure)));
}

/// A distribution over cells, which are drawn from by inversion.
class CellDistribution {
 public:
  explicit CellDistribution(std::span<const double> probability) {
    double sum = 0.0;
    for (const double p : probability) sums_.push_back(sum += p);
  }

  std::vector<std::uint64_t> counts(const RandomStream& stream, std::uint64_t samples) const {
    std::vector<std::uint64_t> counts(sums_.size());
    for (std::uint64_t i = 0; i < samples; ++i) {
      const auto cell = std::upper_bound(sums_.begin(), sums_.end() - 1, stream.point(i).s);
      ++counts[static_cast<std::size_t>(cell - sums_.begin())];
    }
    return counts;
  }

 private:
  std::vector<double> sums_;
};

/// How many of so many replicates the test rejects: rejects(stream of the replicate).
template <class Rejects>
int count_rejections(std::string_view name, int replicates, const Rejects& rejects) {
  const RandomStream all(name, 1);
  int rejected = 0;
  for (int i = 0; i < replicates; ++i) {
    rejected += rejects(all.substream(static_cast<std::uint64_t>(i))) ? 1 : 0;
  }
  return rejected;
}

}  // namespace lightproof
