#include "lightproof/gate/successive.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "lightproof/stats/independence.h"

namespace lightproof {
namespace {

TEST(Successive, PairsAreCountedAtTheirLagInTheirOrder) {
  // Three samples: cells (marginal, conditional) (1, 2), (3, 4), (5, 6).
  const std::vector<TransformedSample> samples = {
      {1.5 / 8, 2.5 / 8}, {3.5 / 8, 4.5 / 8}, {5.5 / 8, 6.5 / 8}};
  std::vector<std::uint8_t> codes;
  for (const TransformedSample& sample : samples) codes.push_back(cells_code(sample));
  SuccessiveCounts counts;
  counts.add_pairs(codes);
  const PairCounts next = counts.pairs(0);
  EXPECT_EQ(next.total, 2U);
  EXPECT_EQ(next.pairs[PairCounts::marginal_marginal](3, 1), 1U);
  EXPECT_EQ(next.pairs[PairCounts::marginal_conditional](4, 1), 1U);
  EXPECT_EQ(next.pairs[PairCounts::conditional_marginal](3, 2), 1U);
  EXPECT_EQ(next.pairs[PairCounts::conditional_conditional](6, 4), 1U);
  const PairCounts after_next = counts.pairs(1);
  EXPECT_EQ(after_next.total, 1U);
  EXPECT_EQ(after_next.pairs[PairCounts::marginal_marginal](5, 1), 1U);
  EXPECT_EQ(counts.pairs(2).total, 0U);
}

TEST(Successive, SamplesThatLeftTheMapAreInNoPair) {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  SuccessiveCounts counts;
  counts.add_pairs(std::vector<std::uint8_t>{
      cells_code({0.1, 0.1}), cells_code({kNowhere, kNowhere}), cells_code({0.9, 0.9})});
  EXPECT_EQ(counts.pairs(0).total, 0U);
  EXPECT_EQ(counts.pairs(1).total, 1U);
}

TEST(Successive, RunsThatAreAllOneCellFallIntoTheirSumsCell) {
  SuccessiveCounts counts;
  counts.add_runs(std::vector<TransformedSample>(2 * kRunLength + 3, {0.999, 0.5 + 1e-9}));
  EXPECT_EQ(counts.runs(0)[kRunCells - 1], 2U);
  EXPECT_EQ(counts.runs(1)[kRunCells / 2], 2U);
}

TEST(Successive, MergedCountsAddUp) {
  SuccessiveCounts one;
  one.add_pairs(std::vector<std::uint8_t>{0, 1, 2});
  SuccessiveCounts both;
  both.merge(one);
  both.merge(one);
  EXPECT_EQ(both.pairs(0).total, 4U);
}

}  // namespace
}  // namespace lightproof
