// The same bits for every kind of vector and every number of weights.
#include "lightproof/samplers/weight_vectors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/samplers/alias_table.h"
#include "tests/core/kinds_of_vectors.h"
#include "tests/core/whole_vectors.h"

namespace lightproof {
namespace {

constexpr std::size_t kMost = 40;

/// Of very different brightness, and some black.
std::vector<Rgb> texels_of(std::size_t count) {
  const RandomStream stream("weights", 1);
  std::vector<Rgb> texels;
  for (std::size_t i = 0; i < count; ++i) {
    const SquarePoint u = stream.point(i);
    const auto light = static_cast<float>(std::exp(20.0 * u.s - 10.0));
    texels.push_back(i % 5 == 3 ? Rgb{} : Rgb{light, static_cast<float>(u.t), 0.5F * light});
  }
  return texels;
}

std::vector<double> weights_of(std::size_t count) {
  std::vector<double> weights;
  for (const Rgb rgb : texels_of(count)) weights.push_back(luminance_of(rgb));
  return weights;
}

TEST(WeightVectors, WeighByLuminanceAndArea) {
  const std::vector<Rgb> texels = texels_of(kMost);
  for_each_kind_of_vector([&](const char* vectors) {
    SCOPED_TRACE(vectors);
    for (std::size_t count = 0; count <= kMost; ++count) {
      std::vector<double> weights(kMost + 1, -1.0);
      weigh(std::span(texels).first(count), kRec709, 0.3, std::span(weights).first(count));
      for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(weights[i], 0.3 * luminance_of(texels[i]));
      EXPECT_EQ(weights[count], -1.0);
    }
  });
}

TEST(WeightVectors, SayWhetherEachWeightIsPossible) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  for_each_kind_of_vector([&](const char* vectors) {
    SCOPED_TRACE(vectors);
    std::vector<double> weights(kMost);
    std::vector<Rgb> texels = texels_of(kMost);
    texels[7] = Rgb(-0.0F);
    texels[8] = Rgb(std::numeric_limits<float>::max());
    EXPECT_TRUE(weigh(texels, kRec709, 0.3, weights).are_possible);
    for (std::size_t at = 0; at < kMost; ++at) {
      for (const float value : {kNaN, -kNaN, kInfinity, -kInfinity, -1e-30F}) {
        std::vector<Rgb> faulty = texels;
        faulty[at] = Rgb(0.0F, value, 0.0F);
        EXPECT_FALSE(weigh(faulty, kRec709, 0.3, weights).are_possible) << at << " " << value;
      }
    }
  });
}

// Texels are asked for some thousand before they are read, as far as there are any.
TEST(WeightVectors, WeighNoMoreThanTheyAreAskedFor) {
  constexpr std::size_t kTexels = 5000;
  const std::vector<Rgb> texels = texels_of(kTexels);
  for_each_kind_of_vector([&](const char* vectors) {
    SCOPED_TRACE(vectors);
    for (const std::size_t count : {std::size_t{0}, std::size_t{17}, std::size_t{3000}, kTexels}) {
      std::vector<double> weights(kTexels + 1, -1.0);
      weigh(texels, kRec709, 0.3, std::span(weights).first(count));
      for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(weights[i], 0.3 * luminance_of(texels[i]));
      EXPECT_EQ(weights[count], -1.0);
    }
  });
}

TEST(WeightVectors, SumsAreTheSameWhateverTheVectors) {
  const std::vector<double> all = weights_of(kMost);
  for_each_kind_of_vector([&](const char* vectors) {
    SCOPED_TRACE(vectors);
    for (std::size_t count = 0; count <= kMost; ++count) {
      const std::span<const double> weights = std::span(all).first(count);
      double lanes[8] = {};
      double least = std::numeric_limits<double>::infinity();
      std::size_t positive = 0;
      for (std::size_t i = 0; i < count; ++i) {
        lanes[i % 8] += weights[i];
        if (weights[i] == 0.0) continue;
        least = std::min(least, weights[i]);
        ++positive;
      }
      WeightSums sums(weights.first(count / 16 * 8));
      sums.add(weights.subspan(count / 16 * 8));
      EXPECT_EQ(sums.sum(), ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) +
                                ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7])));
      EXPECT_EQ(sums.least_positive(), least);
      EXPECT_EQ(sums.positive(), positive);
    }
  });
}

TEST(WeightVectors, FixedPointIsTheNearest) {
  const std::vector<double> weights = weights_of(kMost);
  for_each_kind_of_vector([&](const char* vectors) {
    SCOPED_TRACE(vectors);
    for (const FixedPoint form : {FixedPoint{1.0, 0, 0}, FixedPoint{0x1p20, 0, 1024},
                                  FixedPoint{0x1p45, std::int64_t{1} << 44U, 0}}) {
      for (std::size_t count = 0; count <= kMost; ++count) {
        std::vector<std::int64_t> fixed(kMost + 1, -1);
        to_fixed_point(std::span(weights).first(count), form, std::span(fixed).first(count));
        for (std::size_t i = 0; i < count; ++i) {
          const auto nearest = static_cast<std::int64_t>(std::floor(form.scale * weights[i] + 0.5));
          EXPECT_EQ(fixed[i], weights[i] > 0.0 ? std::max(nearest, form.least) + form.more : 0);
        }
        EXPECT_EQ(fixed[count], -1);
      }
    }
  });
}

TEST(WeightVectors, BalancesCountWhatIsBelowAndWhatIsAbove) {
  const std::uint64_t full = 1000;
  std::vector<std::uint64_t> numbers;
  for (std::size_t i = 0; i < kMost; ++i) numbers.push_back(i % 7 == 0 ? full : 400 * (i % 5));
  numbers[11] = std::uint64_t{1} << 61U;
  for_each_kind_of_vector([&](const char* vectors) {
    SCOPED_TRACE(vectors);
    for (std::size_t count = 0; count <= kMost; ++count) {
      std::uint64_t lack = 0;
      std::uint64_t excess = 0;
      for (std::size_t i = 0; i < count; ++i) {
        (numbers[i] < full ? lack : excess) +=
            numbers[i] < full ? full - numbers[i] : numbers[i] - full;
      }
      const Balance balance = balance_of(std::span(numbers).first(count), full);
      EXPECT_EQ(balance.lack, lack);
      EXPECT_EQ(balance.excess, excess);
    }
  });
}

TEST(WeightVectors, DoWholeVectors) {
  const std::vector<Rgb> texels = texels_of(kMost);
  const std::vector<double> all = weights_of(kMost);
  const std::vector<std::uint64_t> masses(kMost, 7);
  for_each_kind_of_vector([&](const char* vectors) {
    SCOPED_TRACE(vectors);
    for (std::size_t count = 0; count <= kMost; ++count) {
      std::vector<double> weights(count);
      expect_whole_vectors(vectors,
                           weigh(std::span(texels).first(count), kRec709, 1.0, weights).by_vectors,
                           count, 2 * kWidestVector);
      expect_whole_vectors(vectors, WeightSums().add(std::span(all).first(count)), count);
      std::vector<std::int64_t> fixed(count);
      expect_whole_vectors(vectors, to_fixed_point(std::span(all).first(count), {1.0, 0, 0}, fixed),
                           count);
      Balance balance{0, 0};
      expect_whole_vectors(vectors, balance.add(std::span(masses).first(count), 10), count);
    }
  });
}

// A run of columns that one alias fills, and one without any: the entries are those of its columns.
TEST(WeightVectors, WriteWholeVectorsOfAliasEntries) {
  constexpr std::uint64_t kFull = std::uint64_t{1} << AliasTable::kBits;
  constexpr double kUnit = 0x1p-40;
  std::vector<std::uint64_t> masses;
  for (std::size_t i = 0; i < kMost; ++i) masses.push_back(i % 3 == 0 ? kFull : kFull / (i + 2));
  for_each_kind_of_vector([&](const char* vectors) {
    SCOPED_TRACE(vectors);
    for (std::size_t count = 0; count <= kMost; ++count) {
      const AliasRun run = {5, std::span(masses).first(count), 1000};
      std::vector<AliasTable::Entry> entries(count);
      expect_whole_vectors(vectors, write_entries(run, kUnit, 0.5F, entries), count);
      for (std::size_t i = 0; i < count; ++i) {
        const bool small = masses[i] < kFull;
        const auto own = static_cast<float>(kUnit * static_cast<double>(masses[i]));
        EXPECT_EQ(entries[i].threshold, small ? masses[i] : 0U);
        EXPECT_EQ(entries[i].alias, small ? 1000U : 5U + i);
        EXPECT_EQ(entries[i].mass, own);
        EXPECT_EQ(entries[i].alias_mass, small ? 0.5F : own);
      }
    }
  });
}

}  // namespace
}  // namespace lightproof
