// The split sum's error and the pictures of published forms on the page.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "fixture.h"
#include "lightproof/core/measure.h"
#include "lightproof/report/charts.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/published_pictures.h"
#include "lightproof/report/sections.h"

namespace lightproof {
namespace {

using nlohmann::json;

SplitSumRecord record(double degrees, double rmse, double left_out = 0.0) {
  return {"city", 0.5, degrees * kPi / 180.0, 0.04, rmse, left_out};
}

TEST(SplitSumFinding, NamesTheWorstCaseAndTheWorstAlongTheNormal) {
  EXPECT_EQ(
      split_sum_finding({record(0.0, 0.0123), record(0.0, 0.002), record(80.0, 1.5)}),
      "The split sum errs by up to 150\u00a0% of the mean radiance at 80\u00b0 from the normal "
      "(city, roughness 0.5, F0 = 0.04), and along it by up to 1.2\u00a0% (city, roughness "
      "0.5, F0 = 0.04)");
  EXPECT_EQ(split_sum_finding({record(60.0, 0.2)}),
            "The split sum errs by up to 20\u00a0% of the mean radiance at 60\u00b0 from the "
            "normal (city, roughness 0.5, F0 = 0.04)");
  EXPECT_EQ(split_sum_finding({record(0.0, 0.3), record(60.0, 0.2)}),
            "The split sum errs by up to 30\u00a0% of the mean radiance at 0\u00b0 from the "
            "normal (city, roughness 0.5, F0 = 0.04)");
  EXPECT_EQ(split_sum_finding({record(0.0, 1e-9), record(80.0, 2e-6)}),
            "The split sum errs by less than 0.01\u00a0% of the mean radiance everywhere");
}

TEST(SplitSumText, SaysWhereFinerDetailMayAddToIt) {
  EXPECT_EQ(split_sum_text(record(80.0, 0.5, 0.1)), "50\u00a0%");
  EXPECT_EQ(split_sum_text(record(80.0, 0.5, 0.4)), "\u2265 50\u00a0%");
  EXPECT_EQ(split_sum_text(record(80.0, 1e-6, 1e-6)), "< 0.01\u00a0%");
}

TEST(SplitSumChart, HasACellForEveryCaseAndListsToChooseFrom) {
  const std::vector<SplitSumRecord> records = testing::synthetic_study().split_sum;
  const json chart = json::parse(split_sum_chart(records));
  EXPECT_EQ(chart["data"]["values"].size(), records.size());
  ASSERT_EQ(chart["params"].size(), 2U);
  EXPECT_EQ(chart["params"][0]["bind"]["options"].size(), 8U);
  EXPECT_EQ(chart["params"][1]["bind"]["options"], (json{"0.04", "1"}));
  const json& cell = chart["data"]["values"][1];
  EXPECT_EQ(cell["angle"], 80);
  EXPECT_EQ(cell["f0"], "0.04");
  EXPECT_EQ(cell["text"], "\u2265 10\u00a0%");
  EXPECT_NEAR(cell["most"].get<double>(), std::hypot(0.1, 0.08), 1e-5);
}

TEST(SplitSumSection, ShowsEachMap) {
  const std::string html = split_sum_section(testing::synthetic_study().split_sum);
  EXPECT_NE(html.find("<h3>8 maps at once: F0 = 0.04</h3>"), std::string::npos);
  EXPECT_NE(html.find("id=\"split-sum-8\""), std::string::npos);
  EXPECT_EQ(html.find("id=\"split-sum-9\""), std::string::npos);
  EXPECT_NE(html.find("download=\"split_sum.csv\""), std::string::npos);
  EXPECT_NE(split_sum_section({}).find("was not computed"), std::string::npos);
}

TEST(PublishedPictures, StandBesideTheExactOneWithTheirDifferences) {
  const std::string html = published_pictures_html(testing::synthetic_study().published_pictures);
  EXPECT_NE(html.find("<h3>004-2: the published form is off by 880\u00a0%, the corrected one by "
                      "2\u00a0%</h3>"),
            std::string::npos);
  EXPECT_NE(html.find("a sphere &lt;for a test&gt;"), std::string::npos);
  std::size_t pictures = 0;
  for (std::size_t at = html.find("<img "); at != std::string::npos;
       at = html.find("<img ", at + 1))
    ++pictures;
  EXPECT_EQ(pictures, 5U) << "three pictures and two differences";
  EXPECT_EQ(published_pictures_html({}), "");
}

}  // namespace
}  // namespace lightproof
