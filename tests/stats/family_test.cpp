#include "lightproof/stats/family.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lightproof/core/random.h"

namespace lightproof {
namespace {

using testing::Each;
using testing::ElementsAre;

std::vector<bool> rejections(const std::vector<double>& p, double alpha) {
  std::vector<double> log10_p(p.size());
  std::transform(p.begin(), p.end(), log10_p.begin(), [](double x) { return std::log10(x); });
  return holm_rejections(log10_p, alpha);
}

TEST(Holm, OfTheTextbookExample) {
  // Levels .0125, .0167, .025, .05 for .005, .01, .03, .04: the third stops the procedure, though
  // .04 would pass its own level.
  EXPECT_THAT(rejections({0.01, 0.04, 0.03, 0.005}, 0.05), ElementsAre(true, false, false, true));
}

TEST(Holm, RejectsMoreThanBonferroni) {
  // Bonferroni's level is .01 for all of them.
  EXPECT_THAT(rejections({0.04, 0.001, 0.012, 0.016, 0.024}, 0.05), Each(true));
}

TEST(Holm, OfNothingIsNothing) { EXPECT_TRUE(holm_rejections({}, 0.05).empty()); }

TEST(Holm, KeepsTheOrderOfItsInput) {
  const std::vector<double> p = {0.9, 1e-9, 0.5, 1e-12, 0.7, 1e-10};
  EXPECT_THAT(rejections(p, 1e-6), ElementsAre(false, true, false, true, false, true));
}

TEST(Holm, RejectsWhatIsImpossible) {
  const std::vector<double> log10_p = {-0.1, -INFINITY, -3000.0, 0.0, -INFINITY};
  EXPECT_THAT(holm_rejections(log10_p, 1e-6), ElementsAre(false, true, true, false, true));
}

TEST(Holm, LevelsAreInclusive) {
  const double alpha = 1e-6;
  const double at = std::log10(alpha);
  EXPECT_THAT(holm_rejections(std::vector{at}, alpha), ElementsAre(true));
  EXPECT_THAT(holm_rejections(std::vector{std::nextafter(at, 0.0)}, alpha), ElementsAre(false));
  const double half = std::log10(alpha / 2.0);
  EXPECT_THAT(holm_rejections(std::vector{at, half}, alpha), ElementsAre(true, true));
  EXPECT_THAT(holm_rejections(std::vector{at, std::nextafter(half, 0.0)}, alpha),
              ElementsAre(false, false));
}

TEST(Holm, EqualPValuesStandOrFallTogether) {
  EXPECT_THAT(rejections(std::vector<double>(5, 0.0099), 0.05), Each(true));
  EXPECT_THAT(rejections(std::vector<double>(5, 0.0101), 0.05), Each(false));
}

TEST(Holm, HoldsTheFamilyWiseErrorOfIndependentTests) {
  // P(any rejection) = 1 - (1 - alpha/m)^m = 0.0956 for alpha = 0.1 and m = 20; over 10000
  // families its standard deviation is 0.0029, of which 4.9 are exceeded at 1e-6.
  const RandomStream stream("Holm.HoldsTheFamilyWiseErrorOfIndependentTests", 1);
  int wrong = 0;
  for (std::uint64_t family = 0; family < 10000; ++family) {
    std::vector<double> p;
    for (std::uint64_t i = 0; i < 20; ++i) p.push_back(1.0 - stream.substream(family).point(i).s);
    const auto rejected = rejections(p, 0.1);
    if (std::find(rejected.begin(), rejected.end(), true) != rejected.end()) ++wrong;
  }
  EXPECT_NEAR(wrong / 10000.0, 1.0 - std::pow(1.0 - 0.1 / 20.0, 20), 4.9 * 0.0029);
}

// In a run of which a part is done again the part must not reject what the whole accepted, though
// it has fewer tests: both count the same family.
TEST(Holm, APartOfAFamilyRejectsNothingThatTheWholeAccepts) {
  const std::vector<double> whole = {-7.0, -5.0, -2.0, -0.5, -0.3};
  const double alpha = 1e-4;  // levels -4.7, -4.6, ...
  EXPECT_THAT(holm_rejections(whole, alpha, 100), ElementsAre(true, false, false, false, false));
  EXPECT_THAT(holm_rejections(std::vector{-5.0}, alpha, 100), ElementsAre(false));
  EXPECT_THAT(holm_rejections(std::vector{-5.0}, alpha), ElementsAre(true));
  EXPECT_THAT(holm_rejections(std::vector{-7.0}, alpha, 100), ElementsAre(true));
}

TEST(Holm, StrictestLevelIsBonferronis) {
  EXPECT_EQ(strictest_level(1e-6, 1), 1e-6);
  EXPECT_EQ(strictest_level(1e-6, 8), 1.25e-7);
  EXPECT_EQ(strictest_level(1e-6, 0), 1e-6);
}

TEST(Holm, WhatIsNotANumberIsRejectedAndHidesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(holm_rejections(std::vector<double>{nan, -20.0, -0.1}, 1e-6),
            (std::vector<bool>{true, true, false}));
}

}  // namespace
}  // namespace lightproof
