// How cases of a survey are judged and counted.
#include "lightproof/results/recommendation_survey.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightproof {
namespace {

SurveyCase case_of(double error, double seconds) {
  return {"map",  "lambert", 0.1,  SurveyedChoice{"brdf", 4, 0.1, 0.1, error, seconds},
          "sh-9", 1.0,       false};
}

SurveyCase refused(const char* best) { return {"map", "lambert", 0.1, {}, best, 1.0, true}; }

TEST(SurveyCase, JudgesErrorAndTime) {
  EXPECT_TRUE(case_of(0.109, 1.4).error_is_kept() && case_of(0.109, 1.4).time_is_kept());
  EXPECT_EQ(case_of(0.109, 1.4).badness(), 0.0);
  EXPECT_FALSE(case_of(0.111, 1.4).error_is_kept());
  EXPECT_NEAR(case_of(0.22, 1.4).badness(), 2.0, 1e-12);
  EXPECT_FALSE(case_of(0.109, 1.6).time_is_kept());
  EXPECT_NEAR(case_of(0.22, 4.5).badness(), 3.0, 1e-12);
  SurveyCase alone = case_of(0.1, 1e6);
  alone.best.clear();
  EXPECT_TRUE(alone.time_is_kept());
  EXPECT_TRUE(refused("").is_rightly_refused());
  EXPECT_FALSE(refused("brdf").is_rightly_refused());
  EXPECT_TRUE(std::isinf(refused("brdf").badness()));
}

// Right refusals would make a survey of hard questions look good.
TEST(SurveyShares, CountRefusalsApart) {
  const SurveyShares shares = shares_of({case_of(0.1, 1.0), case_of(0.2, 1.0), case_of(0.1, 2.0),
                                         refused("brdf"), refused(""), refused("")});
  EXPECT_EQ(shares.answered, 4U);
  EXPECT_EQ(shares.rightly_refused, 2U);
  EXPECT_EQ(shares.wrongly_refused, 1U);
  EXPECT_DOUBLE_EQ(shares.errors_kept, 0.5);
  EXPECT_DOUBLE_EQ(shares.times_kept, 0.5);
  EXPECT_FALSE(shares.reaches_goals());
  EXPECT_TRUE(shares_of({case_of(0.1, 1.0), refused("")}).reaches_goals());
}

TEST(RecommendationSurvey, HasItsMapsApartAndItsWorstFirst) {
  const RecommendationSurvey survey = {
      "",
      "sphere",
      "draft",
      {case_of(0.2, 1.0), refused("brdf"), case_of(0.1, 1.0), case_of(0.4, 1.0)}};
  EXPECT_EQ(cases_of(survey, true).size(), 1U);
  EXPECT_EQ(cases_of(survey, false).size(), 3U);
  const auto worst = worst_of(survey.cases, 2);
  ASSERT_EQ(worst.size(), 2U);
  EXPECT_FALSE(worst[0].choice);
  EXPECT_EQ(worst[1].choice->error, 0.4);
  EXPECT_EQ(worst_of(survey.cases, 9).size(), 3U);
}

}  // namespace
}  // namespace lightproof
