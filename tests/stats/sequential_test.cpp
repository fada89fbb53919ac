#include "lightproof/stats/sequential.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "all_counts.h"
#include "lightproof/core/random.h"
#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

using Counts = std::vector<std::uint64_t>;
using Probabilities = std::vector<double>;

double e_of(const SequentialTest& test, const Counts& counts) {
  return std::pow(10.0, test.log10_e(counts));
}

/// E as the product of what each sample multiplies it by, the predictive probability of its cell
/// over p: (n_i + c p_i) / ((n + c) p_i). Averaged over c, in 64 bits of precision.
long double log10_by_prediction(const SequentialTest& test, const Probabilities& p,
                                const Counts& counts) {
  long double sum = 0.0L;
  for (const double concentration : test.concentrations()) {
    const auto c = static_cast<long double>(concentration);
    long double e = 1.0L;
    long double n = 0.0L;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const auto q = static_cast<long double>(p[i]);
      for (std::uint64_t k = 0; k < counts[i]; ++k, n += 1.0L) {
        e *= (static_cast<long double>(k) + c * q) / ((n + c) * q);
      }
    }
    sum += e;
  }
  return std::log10(sum / static_cast<long double>(test.concentrations().size()));
}

double multinomial(const Probabilities& p, const Counts& counts) {
  double probability = 1.0;
  double n = 1.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::uint64_t k = 1; k <= counts[i]; ++k, n += 1.0) {
      probability *= p[i] * n / static_cast<double>(k);
    }
  }
  return probability;
}

const std::vector<Probabilities>& small_distributions() {
  static const std::vector<Probabilities> distributions = {
      {0.5, 0.5}, {0.999, 0.001}, {0.2, 0.3, 0.5}, {0.1, 0.2, 0.3, 0.4}, {0.97, 0.01, 0.01, 0.01}};
  return distributions;
}

TEST(SequentialTest, HasAnExpectationOfOneUnderTheNull) {
  for (const Probabilities& p : small_distributions()) {
    const SequentialTest test(p);
    for (std::uint64_t samples = 1; samples <= 6; ++samples) {
      double expectation = 0.0;
      Counts counts(p.size());
      for_all_counts(counts, 0, samples, [&](const Counts& outcome) {
        expectation += multinomial(p, outcome) * e_of(test, outcome);
      });
      EXPECT_NEAR(expectation, 1.0, 1e-12) << p.size() << " cells, " << samples << " samples";
    }
  }
}

TEST(SequentialTest, IsAMartingaleFromWhereverItStands) {
  for (const Probabilities& p : small_distributions()) {
    const SequentialTest test(p);
    Counts counts(p.size());
    for_all_counts(counts, 0, 12, [&](const Counts& now) {
      double expectation = 0.0;
      for (std::size_t i = 0; i < p.size(); ++i) {
        Counts next = now;
        ++next[i];
        expectation += p[i] * e_of(test, next);
      }
      const double e = e_of(test, now);
      EXPECT_NEAR(expectation, e, 1e-12 * e);
    });
  }
}

TEST(SequentialTest, MultipliesByThePredictiveProbabilityOfEverySample) {
  const Probabilities p = {0.6, 0.25, 0.125, 0.0249, 1e-4};
  const SequentialTest test(p);
  for (const Counts& counts :
       {Counts{1, 0, 0, 0, 0}, Counts{0, 0, 0, 0, 1}, Counts{0, 0, 0, 0, 7}, Counts{6, 2, 1, 0, 0},
        Counts{60, 25, 12, 3, 0}, Counts{610, 245, 120, 25, 0}, Counts{400, 400, 100, 90, 10},
        Counts{0, 1000, 0, 0, 0}, Counts{0, 0, 200, 300, 50}}) {
    const auto exact = static_cast<double>(log10_by_prediction(test, p, counts));
    EXPECT_NEAR(test.log10_e(counts), exact, 1e-13 * (1.0 + std::abs(exact)));
  }
}

TEST(SequentialTest, KeepsItsDigitsForABillionSamples) {
  // From the formula of the header with 60 digits (mpmath's loggamma), with the same grid of c.
  // Rounding: a few eps of every term, of which the largest is the result itself; and the
  // probabilities are doubles that sum to 1 within an eps, of which there are N.
  struct Row {
    Probabilities p;
    Counts counts;
    double log10_e;
  };
  const std::vector<Row> rows = {
      {{0.5, 0.5}, {500000000, 500000000}, -2.2791290601893243},
      {{0.5, 0.5}, {500100000, 499900000}, 6.4026487197187655},
      {{0.5, 0.5}, {600000000, 400000000}, 8744737.7846240913},
      {{0.25, 0.5, 0.25}, {250020000, 499970000, 250010000}, -2.8963778360615698},
      {{0.125, 0.75, 0.0625, 0.0625}, {1250, 7500, 630, 620}, -0.4748375735445227},
      {{0.1, 0.2, 0.3, 0.4}, {100000000, 200010000, 300000000, 399990000}, -5.0089967499614465},
      {{0.999999, 1e-06}, {999998900, 1100}, -0.34637454828218151},
      {{0.999999, 1e-06}, {1000000000, 0}, 434.18539593782368},
      {{0.999, 0.0005, 0.0005}, {0, 100, 0}, 323.46921846475682},
  };
  for (const Row& row : rows) {
    const auto samples = static_cast<double>(
        std::accumulate(row.counts.begin(), row.counts.end(), std::uint64_t{0}));
    const double rounding =
        std::numeric_limits<double>::epsilon() * (samples + 8.0 * std::abs(row.log10_e) + 100.0);
    EXPECT_NEAR(SequentialTest(row.p).log10_e(row.counts), row.log10_e, rounding);
  }
}

TEST(SequentialTest, DoesNotDependOnTheOrderOfTheCells) {
  const Probabilities p = {0.1, 0.2, 0.3, 0.4};
  const Counts counts = {20, 10, 31, 39};
  const double e = SequentialTest(p).log10_e(counts);
  std::array<std::size_t, 4> order = {0, 1, 2, 3};
  while (std::next_permutation(order.begin(), order.end())) {
    Probabilities shuffled_p;
    Counts shuffled;
    for (const std::size_t i : order) {
      shuffled_p.push_back(p[i]);
      shuffled.push_back(counts[i]);
    }
    EXPECT_NEAR(SequentialTest(shuffled_p).log10_e(shuffled), e, 1e-13);
  }
}

TEST(SequentialTest, StartsAtOne) {
  EXPECT_EQ(SequentialTest(Probabilities{0.5, 0.5}).log10_e(Counts{0, 0}), 0.0);
}

TEST(SequentialTest, SaysNothingOfTheFirstSampleOrOfASingleCell) {
  // The prior's mean is p: the first sample is predicted with its own probability.
  const SequentialTest test(Probabilities{0.7, 0.299, 0.001});
  for (const Counts& first : {Counts{1, 0, 0}, Counts{0, 1, 0}, Counts{0, 0, 1}}) {
    EXPECT_NEAR(test.log10_e(first), 0.0, 1e-14);
  }
  EXPECT_NEAR(SequentialTest(Probabilities{1.0}).log10_e(Counts{1000000000}), 0.0, 1e-14);
}

TEST(SequentialTest, IsInfiniteAfterAnImpossibleHit) {
  const SequentialTest test(Probabilities{0.5, 0.0, 0.5});
  EXPECT_EQ(test.log10_e(Counts{0, 1, 0}), INFINITY);
  EXPECT_EQ(test.log10_e(Counts{500, 1, 500}), INFINITY);
  EXPECT_TRUE(SequentialTest::rejects(INFINITY, 1e-300));
}

TEST(SequentialTest, IgnoresImpossibleCellsThatAreNotHit) {
  const double without = SequentialTest(Probabilities{0.3, 0.7}).log10_e(Counts{40, 60});
  const double with =
      SequentialTest(Probabilities{0.0, 0.3, 0.0, 0.7, 0.0}).log10_e(Counts{0, 40, 0, 60, 0});
  EXPECT_EQ(with, without);
}

TEST(SequentialTest, CoversEffectsFromTheSmallestToAllMassInOneCell) {
  for (const std::size_t cells : {2U, 3U, 512U}) {
    const SequentialTest test(Probabilities(cells, 1.0 / static_cast<double>(cells)));
    const auto c = test.concentrations();
    EXPECT_EQ(c.front(), 1.0);
    // w^2 = (k - 1) / (c + 1).
    const double dof = static_cast<double>(cells) - 1.0;
    EXPECT_LT(std::sqrt(dof / (c.back() + 1.0)), 1.5 * kSmallestSequentialEffect);
    for (std::size_t i = 1; i < c.size(); ++i) EXPECT_EQ(c[i], 2.0 * c[i - 1]);
  }
}

TEST(SequentialTest, RejectsFromOneOverAlphaOn) {
  EXPECT_TRUE(SequentialTest::rejects(6.0, 1e-6));
  EXPECT_FALSE(SequentialTest::rejects(5.999, 1e-6));
  EXPECT_FALSE(SequentialTest::rejects(-INFINITY, 0.5));
}

/// Samples of equal cells of which every odd one gives the share `defect` of its mass to the even
/// one before it: (q - p) / p is +-defect in all cells, which is the effect w.
class EvenCells {
 public:
  explicit EvenCells(std::size_t cells, double defect = 0.0) : cells_(cells), defect_(defect) {}

  Probabilities probability() const {
    return Probabilities(cells_, 1.0 / static_cast<double>(cells_));
  }

  std::size_t draw(const RandomStream& stream, std::uint64_t sample) const {
    const SquarePoint u = stream.point(sample);
    const auto index = static_cast<std::size_t>(u.s * static_cast<double>(cells_));
    return index % 2 == 1 && u.t < defect_ ? index - 1 : index;
  }

 private:
  std::size_t cells_;
  double defect_;
};

/// The number of samples at which the test stops, looking every `stride`; `most` + 1 if it has not
/// by then.
std::uint64_t samples_to_stop(const EvenCells& distribution, const SequentialTest& test,
                              const RandomStream& stream, double alpha, std::uint64_t stride,
                              std::uint64_t most) {
  Counts counts(distribution.probability().size());
  for (std::uint64_t n = 1; n <= most; ++n) {
    ++counts[distribution.draw(stream, n)];
    const bool looks = n % stride == 0 || (n & (n - 1)) == 0;
    if (looks && SequentialTest::rejects(test.log10_e(counts), alpha)) return n;
  }
  return most + 1;
}

TEST(SequentialCalibration, WatchedAllTheTimeItSeldomEverRejectsTheNull) {
  constexpr int kReplicates = 2000;
  constexpr double kAlpha = 0.05;
  constexpr std::uint64_t kMost = 16384;
  const EvenCells distribution(4);
  const SequentialTest test(distribution.probability());
  const RandomStream all("SequentialCalibration.WatchedAllTheTimeItSeldomEverRejectsTheNull", 1);
  int rejected = 0;
  for (std::uint64_t replicate = 0; replicate < kReplicates; ++replicate) {
    const RandomStream stream = all.substream(replicate);
    if (samples_to_stop(distribution, test, stream, kAlpha, 64, kMost) <= kMost) ++rejected;
  }
  // Ville: each replicate is a false alarm with a probability of at most alpha, so that their
  // number exceeds this quantile with at most 1e-6.
  const boost::math::binomial at_most(kReplicates, kAlpha);
  EXPECT_LE(rejected, boost::math::quantile(boost::math::complement(at_most, 1e-6)));
}

/// How many of `replicates` stop within `most` samples.
int stopped_within(const char* name, const EvenCells& distribution, double alpha,
                   std::uint64_t stride, std::uint64_t most, std::uint64_t replicates) {
  const SequentialTest test(distribution.probability());
  const RandomStream all(name, 1);
  int stopped = 0;
  for (std::uint64_t i = 0; i < replicates; ++i) {
    if (samples_to_stop(distribution, test, all.substream(i), alpha, stride, most) <= most)
      ++stopped;
  }
  return stopped;
}

TEST(SequentialPower, StopsALargeDefectLongBeforeTheFixedNumberOfSamples) {
  // All odd cells empty: 256 of 512 hold everything, w = 1. At c = 512 log E is
  // sum log n_i! - log (Gamma(N + c) / (Gamma(c) c^N)), by convexity smallest for even counts:
  // 814 - 663 = 150 or more at N = 1024, of which the average over c takes at most log 29 = 3.4.
  // That is above log(1 / alpha) = 13.8 on every run, 4 thousand times before the fixed 4 million.
  EXPECT_EQ(SequentialTest(EvenCells(512).probability()).concentrations().size(), 29U);
  EXPECT_EQ(
      stopped_within("SequentialPower.StopsALargeDefect", EvenCells(512, 1.0), 1e-6, 16, 1024, 20),
      20);
}

TEST(SequentialPower, NeedsFewerSamplesThanTheFixedTestOnMostRuns) {
  // At the number of samples that the chi-square test of the same alpha needs for a power of .99,
  // N w^2 = lambda. With k - 1 = 255 degrees of freedom, lambda = 204 and the best c of
  // (k - 1) / w^2, log E is normal, nearly, with mean ((k - 1) log(1 - v) + lambda) / 2 = 27,
  // v = lambda / (lambda + k - 1), and standard deviation v sqrt(2 (k - 1) + 4 lambda) / 2 = 8.
  // The best c are 1020 and 4080, of which the grid has neighbours; averaging takes off at most
  // log 28 = 3.3. What is left is above log(1 / alpha) = 13.8 by 1.2 standard deviations, in at
  // least four runs of five. Fewer than half of 100 would have a probability of 1e-10.
  constexpr double kAlpha = 1e-6;
  const double lambda = minimum_detectable_noncentrality(255.0, kAlpha, 0.99);
  for (const double w : {0.5, 0.25}) {
    const auto fixed = static_cast<std::uint64_t>(lambda / (w * w));
    EXPECT_GT(stopped_within("SequentialPower.NeedsFewerSamples", EvenCells(256, w), kAlpha,
                             fixed / 32, fixed, 100),
              50)
        << w;
  }
}

}  // namespace
}  // namespace lightproof
