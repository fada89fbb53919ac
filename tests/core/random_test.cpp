#include "lightproof/core/random.h"

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <vector>

#include "lightproof/stats/goodness_of_fit.h"

namespace lightproof {
namespace {

using Words = std::array<std::uint32_t, 4>;

/// Counter, key and output of kat_vectors, as published with Random123 ("philox4x32 10").
struct KnownAnswer {
  Words counter;
  std::array<std::uint32_t, 2> key;
  Words output;
};

constexpr std::uint32_t kOnes = 0xffffffffU;
constexpr KnownAnswer kKnownAnswers[] = {
    {{0, 0, 0, 0}, {0, 0}, {0x6627e8d5U, 0xe169c58dU, 0xbc57ac4cU, 0x9b00dbd8U}},
    {{kOnes, kOnes, kOnes, kOnes},
     {kOnes, kOnes},
     {0x408f276dU, 0x41c83b0eU, 0xa20bc7c6U, 0x6d5451fdU}},
    {{0x243f6a88U, 0x85a308d3U, 0x13198a2eU, 0x03707344U},
     {0xa4093822U, 0x299f31d0U},
     {0xd16cfe09U, 0x94fdccebU, 0x5001e420U, 0x24126ea1U}},
};

constexpr std::uint64_t joined(std::uint32_t low, std::uint32_t high) {
  return (std::uint64_t{high} << 32U) | low;
}

/// The inverse of v ^= v >> shift.
constexpr std::uint64_t unshifted(std::uint64_t v, unsigned shift) {
  std::uint64_t result = v;
  for (unsigned done = shift; done < 64; done += shift) result = v ^ (result >> shift);
  return result;
}

/// The inverse of an odd number modulo 2^64: every Newton step doubles the right bits.
constexpr std::uint64_t inverse(std::uint64_t odd) {
  std::uint64_t result = odd;
  for (int i = 0; i < 6; ++i) result *= 2 - odd * result;
  return result;
}

/// The base seed that SplitMix64's finaliser takes to `mixed`.
constexpr std::uint64_t seed_mixed_to(std::uint64_t mixed) {
  std::uint64_t v = unshifted(mixed, 31) * inverse(0x94d049bb133111ebULL);
  v = unshifted(v, 27) * inverse(0xbf58476d1ce4e5b9ULL);
  return unshifted(v, 30) - 0x9e3779b97f4a7c15ULL;
}

TEST(HashText, IsFnv1a) {
  // Test vectors of the FNV reference code.
  EXPECT_EQ(hash_text(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(hash_text("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(hash_text("foobar"), 0x85944171f73967e8ULL);
}

TEST(UnitInterval, StaysBelowOneAndReachesZero) {
  EXPECT_EQ(unit_interval(0, 0), 0.0);
  EXPECT_LT(unit_interval(kOnes, kOnes), 1.0);
  EXPECT_EQ(unit_interval(kOnes, kOnes), 1.0 - 0x1p-53);
  EXPECT_EQ(unit_interval(0, 0x80000000U), 0.5);
  EXPECT_EQ(unit_interval(1U << 11U, 0), 0x1p-53);
  EXPECT_EQ(unit_interval((1U << 11U) - 1U, 0), 0.0);
}

TEST(RandomStream, GivesThePublishedNumbersOfPhilox) {
  for (const KnownAnswer& known : kKnownAnswers) {
    const auto& [c, k, out] = known;
    const auto direct = r123::Philox4x32{}({{c[0], c[1], c[2], c[3]}}, {{k[0], k[1]}});
    for (std::size_t i = 0; i < out.size(); ++i) EXPECT_EQ(direct[i], out[i]);

    const std::uint64_t seed = seed_mixed_to(joined(k[0], k[1]) ^ hash_text("known answer"));
    const RandomStream stream("known answer", seed, joined(c[2], c[3]));
    const SquarePoint point = stream.point(joined(c[0], c[1]));
    EXPECT_EQ(point.s, unit_interval(out[0], out[1]));
    EXPECT_EQ(point.t, unit_interval(out[2], out[3]));
  }
}

TEST(RandomStream, IsAFunctionOfNameSeedSubstreamAndIndex) {
  const RandomStream once("pure", 7, 3);
  const RandomStream again("pure", 7, 3);
  const RandomStream derived = RandomStream("pure", 7, 99).substream(3);
  std::vector<SquarePoint> forwards;
  for (std::uint64_t i = 0; i < 1000; ++i) forwards.push_back(once.point(i));
  for (std::uint64_t i = 1000; i-- > 0;) {
    EXPECT_EQ(once.point(i), forwards[i]);
    EXPECT_EQ(again.point(i), forwards[i]);
    EXPECT_EQ(derived.point(i), forwards[i]);
  }
}

TEST(RandomStream, DiffersWithEveryArgument) {
  std::set<std::pair<double, double>> seen;
  std::size_t drawn = 0;
  const auto draw = [&](const RandomStream& stream) {
    // Indices beyond 2^32 too: their upper half is part of the counter.
    for (const std::uint64_t index : {0ULL, 1ULL, 2ULL, 1ULL << 32U, 1ULL << 63U}) {
      const SquarePoint point = stream.point(index);
      seen.insert({point.s, point.t});
      ++drawn;
    }
  };
  for (const char* name : {"", "a", "b", "ab", "ba"}) {
    for (const std::uint64_t seed : {0ULL, 1ULL, 2ULL, 1ULL << 32U, ~0ULL}) {
      for (const std::uint64_t substream : {0ULL, 1ULL, 2ULL, 1ULL << 32U, ~0ULL}) {
        draw(RandomStream(name, seed, substream));
      }
    }
  }
  // Two of 625 points of 106 bits agree by chance with a probability below 1e-26.
  EXPECT_EQ(seen.size(), drawn);
}

/// log10 p of 2^20 points on 64 x 64 equal cells, 256 expected in each.
double uniformity(const std::function<SquarePoint(std::uint64_t)>& point) {
  constexpr std::uint64_t kPoints = 1U << 20U;
  std::vector<std::uint64_t> counts(std::size_t{64} * 64);
  for (std::uint64_t i = 0; i < kPoints; ++i) {
    const SquarePoint at = point(i);
    ++counts.at(static_cast<std::size_t>(at.t * 64.0) * 64 + static_cast<std::size_t>(at.s * 64.0));
  }
  const std::vector<double> probability(counts.size(), 1.0 / static_cast<double>(counts.size()));
  const GoodnessOfFit fit = cressie_read(counts, probability, kPoints);
  EXPECT_EQ(fit.dof, 64.0 * 64.0 - 1.0);
  return fit.log10_p;
}

// alpha = 1e-6 from both sides for each of the five: too even is as wrong as too uneven.
void expect_plausible(double log10_p) {
  EXPECT_GT(log10_p, -6.0);
  EXPECT_LT(log10_p, std::log10(1.0 - 1e-6));
}

TEST(RandomStream, IsUniformOverTheSquare) {
  const RandomStream stream("RandomStream.IsUniformOverTheSquare", 1);
  expect_plausible(uniformity([&](std::uint64_t i) { return stream.point(i); }));
}

TEST(RandomStream, IsIndependentOfTheNextIndex) {
  const RandomStream stream("RandomStream.IsIndependentOfTheNextIndex", 1);
  expect_plausible(uniformity([&](std::uint64_t i) {
    return SquarePoint{stream.point(2 * i).s, stream.point(2 * i + 1).s};
  }));
}

TEST(RandomStream, IsIndependentOfTheNextSubstream) {
  const RandomStream stream("RandomStream.IsIndependentOfTheNextSubstream", 1);
  expect_plausible(uniformity([&](std::uint64_t i) {
    return SquarePoint{stream.substream(2 * i).point(0).t, stream.substream(2 * i + 1).point(0).t};
  }));
}

TEST(RandomStream, IsIndependentOfTheNextSeed) {
  expect_plausible(uniformity([&](std::uint64_t i) {
    return SquarePoint{RandomStream("seeds", 2 * i).point(0).s,
                       RandomStream("seeds", 2 * i + 1).point(0).s};
  }));
}

TEST(RandomStream, FillsTheLowBits) {
  // The lowest 12 of the 53 bits of each coordinate, as a point of a 64 x 64 grid each.
  const RandomStream stream("RandomStream.FillsTheLowBits", 1);
  expect_plausible(uniformity([&](std::uint64_t i) {
    const double low = stream.point(i).s * 0x1p41;
    const double fraction = (low - std::floor(low)) * 64.0;
    return SquarePoint{std::floor(fraction) / 64.0, fraction - std::floor(fraction)};
  }));
}

}  // namespace
}  // namespace lightproof
