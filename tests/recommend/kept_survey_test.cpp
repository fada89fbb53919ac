// A survey that is kept for reports.
#include <gtest/gtest.h>

#include "lightproof/core/temporary_folder.h"
#include "lightproof/recommend/survey.h"

namespace lightproof {
namespace {

TEST(KeptSurvey, IsReadAsItWasKept) {
  const TemporaryFolder folder;
  EXPECT_FALSE(kept_survey(folder / ""));
  RecommendationSurvey survey = {"today", "sphere", "default", {}};
  survey.cases = {{"map", "lambert", 0.05, SurveyedChoice{"brdf", 4, 0.05, 0.04, 0.06, 1e-6},
                   "sh-9", 2e-6, true},
                  {"map", "lambert", 0.01, std::nullopt, "", 0.0, false}};
  ASSERT_TRUE(keep_survey(folder / "", survey));
  const auto kept = kept_survey(folder / "");
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->origin, "today");
  ASSERT_EQ(kept->cases.size(), 2U);
  EXPECT_EQ(kept->cases[0].choice->estimator, "brdf");
  EXPECT_EQ(kept->cases[0].choice->verified_error, 0.04);
  EXPECT_TRUE(kept->cases[0].was_tuned_on);
  EXPECT_FALSE(kept->cases[1].choice);
  survey.origin = "tomorrow";
  ASSERT_TRUE(keep_survey(folder / "", survey));
  EXPECT_EQ(kept_survey(folder / "")->origin, "tomorrow");
}

}  // namespace
}  // namespace lightproof
