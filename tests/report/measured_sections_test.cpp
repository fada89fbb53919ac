// The sections on frames, point sets and levels say what their records say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "lightproof/report/measured_csv.h"
#include "lightproof/report/measured_json.h"
#include "lightproof/report/sections.h"
#include "lightproof/report/stability_json.h"
#include "lightproof/report/stability_tables.h"
#include "measured_fixture.h"

namespace lightproof {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// The specification of a chart of a page's part.
json chart_of(const std::string& html, const std::string& id) {
  constexpr std::string_view kBegin = "<script type=\"application/json\">";
  const std::size_t figure = html.find("id=\"" + id + "\"");
  EXPECT_NE(figure, std::string::npos) << id;
  const std::size_t begin = html.find(kBegin, figure) + kBegin.size();
  return json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

TEST(FrameSection, NamesTheFramesThatAreNotOrthonormal) {
  const std::string html = frame_section(testing::synthetic_frames());
  EXPECT_THAT(html,
              HasSubstr("Orthonormal at every normal: straight. "
                        "Around \u2212z, in float, bent is not finite within 1e\u22126 rad."));
  EXPECT_THAT(html, HasSubstr("Around \u2212z, one of two constructions lose"));
  EXPECT_THAT(html, HasSubstr("Around +z, none of two constructions lose"));
}

TEST(FrameSection, LeavesOutWhatIsNotFinite) {
  const std::string html = frame_section(testing::synthetic_frames());
  EXPECT_EQ(chart_of(html, "frames-zenith")["data"]["values"].size(), 16U);
  EXPECT_EQ(chart_of(html, "frames-nadir")["data"]["values"].size(), 14U);
}

TEST(PointSection, NamesTheSteepestAndTheMostEvenSet) {
  const std::string html = point_section(testing::synthetic_points());
  EXPECT_THAT(html, HasSubstr("Errors of steep fall fastest where the integrand is smooth, as "
                              "N^(\u22121.500 \u00b1 0.020); at edges those of all even sets as "
                              "N^(\u22120.95) to N^(\u22120.95)"));
  EXPECT_THAT(html, HasSubstr("The most even of 1,024 points are those of steep"));
  EXPECT_THAT(html, HasSubstr("one of the two sets in float has at most 256 different values"));
}

TEST(PointSection, HasEverySetInItsCharts) {
  const std::string html = point_section(testing::synthetic_points());
  const json rates = chart_of(html, "points-rates");
  EXPECT_EQ(rates["layer"][2]["data"]["values"].size(), 4U) << "without those of no exponent";
  EXPECT_EQ(rates["layer"][2]["encoding"]["y"]["sort"], (json{"random", "steep", "exact"}));
  EXPECT_EQ(chart_of(html, "points-discrepancy")["data"]["values"].size(), 6U);
  EXPECT_EQ(chart_of(html, "points-decay")["data"]["values"].size(), 50U);
}

TEST(LevelCostSection, SaysHowFarTheUsualLoopIsBehind) {
  const std::string html = level_cost_section(testing::synthetic_level_costs());
  EXPECT_THAT(html,
              HasSubstr("Irradiance: 8 ms for an error of 4e\u22128 by closed form, 64 ms for "
                        "an error of 0.050 by half-vector with 1024 samples"));
  EXPECT_THAT(html, HasSubstr("A second thread makes the chain of levels 2 times as fast"));
}

// Below 1e-5 errors are the quadrature's: a slower method is not better for a smaller one.
TEST(LevelCostSection, NamesTheFastestOfTheMethodsThatAreAsExactAsTheQuadrature) {
  LevelCosts costs = testing::synthetic_level_costs();
  for (std::size_t i = 0, all = costs.levels.size(); i < all; ++i) {
    if (costs.levels[i].method != "closed form") continue;
    LevelCost slower = costs.levels[i];
    slower.method = "slower";
    slower.milliseconds.median *= 4.0;
    slower.error *= 0.1;
    costs.levels.push_back(slower);
  }
  EXPECT_THAT(level_cost_section(costs),
              HasSubstr("Irradiance: 8 ms for an error of 4e\u22128 by closed form"));
}

TEST(LevelCostSection, SaysWhetherTheMachineWasBusy) {
  LevelCosts costs = testing::synthetic_level_costs();
  EXPECT_THAT(level_cost_section(costs),
              AllOf(HasSubstr("The machine was busy"), HasSubstr("up to 2.5 times")));
  costs.gains.front().wall_over_processor = 1.02;
  EXPECT_THAT(level_cost_section(costs),
              AllOf(HasSubstr("The machine was idle"), Not(HasSubstr("was busy"))));
}

TEST(LevelCostSection, RingsWhatNothingBeatsOnTheSameMap) {
  LevelCosts costs = testing::synthetic_level_costs();
  costs.levels.back().error = 0.3;  // on the second map, beaten there by the usual loop
  const json rows = chart_of(level_cost_section(costs), "levels-1")["data"]["values"];
  ASSERT_EQ(rows.size(), 8U);
  std::vector<bool> on_front;
  for (const json& row : rows) on_front.push_back(row["front"] == "on the front");
  EXPECT_EQ(on_front, (std::vector{true, false, false, true, true, true, false, false}));
}

TEST(LevelCostSection, OffersTheMapsThatThereAre) {
  LevelCosts costs = testing::synthetic_level_costs();
  const auto params = [&] { return chart_of(level_cost_section(costs), "levels-1")["params"]; };
  EXPECT_EQ(params()[0]["bind"]["options"], (json{"city", "courtyard"}));
  costs.levels.resize(4);
  EXPECT_TRUE(params().is_null());
}

TEST(MeasuredSections, SayWhatWasNotMeasured) {
  EXPECT_THAT(frame_section({}), HasSubstr("were not measured"));
  EXPECT_THAT(point_section({}), HasSubstr("were not measured"));
  EXPECT_THAT(level_cost_section({}), HasSubstr("were not measured"));
}

TEST(MeasuredCsv, HasOneRowPerRecordBelowItsHeading) {
  const auto lines = [](const std::string& csv) {
    return std::count(csv.begin(), csv.end(), '\n');
  };
  const PointStudy points = testing::synthetic_points();
  const LevelCosts costs = testing::synthetic_level_costs();
  EXPECT_EQ(lines(frames_csv(testing::synthetic_frames())), 1 + 32);
  EXPECT_EQ(lines(point_errors_csv(points.rates)), 1 + 6 * 3);
  EXPECT_EQ(lines(discrepancy_csv(points.discrepancies)), 1 + 6);
  EXPECT_EQ(lines(decay_csv(points.decay)), 1 + 50);
  EXPECT_EQ(lines(level_costs_csv(costs.levels)), 1 + 8);
  EXPECT_EQ(lines(thread_gains_csv(costs.gains)), 1 + 1);
  EXPECT_THAT(thread_gains_csv(costs.gains), HasSubstr("chain of levels,10,9,12,5,4.5,6,2,2.5\n"));
}

TEST(MeasuredJson, HasNumbersAndNull) {
  const json points = json::parse(points_json(testing::synthetic_points()).dump());
  EXPECT_EQ(points["rates"][2]["exponent"], -1.5);
  EXPECT_TRUE(points["rates"][4]["exponent"].is_null());
  const json frames = json::parse(frames_json(testing::synthetic_frames()).dump());
  EXPECT_EQ(frames[16]["construction"], "bent");
  EXPECT_EQ(frames[16]["error"], 1e308);
  const json costs = json::parse(level_costs_json(testing::synthetic_level_costs()).dump());
  EXPECT_EQ(costs["thread_gains"][0]["gain"], 2.0);
  EXPECT_EQ(costs["levels"][0]["map_size"], (json{1024, 512}));
}

TEST(StabilitySection, ShowsEveryOutcomeAndFramesBrokenClaims) {
  const std::string html = stability_section(testing::synthetic_stability());
  EXPECT_THAT(html,
              AllOf(HasSubstr("3 of 4 claims kept, 1 broken; 3 failures that are published or "
                              "in the nature of the method; 1 not applicable."),
                    HasSubstr("Samplers: 3 of 4 claims kept; 3 methods fail somewhere"),
                    HasSubstr("put &lt;in&gt;"), Not(HasSubstr("put <in>"))));
  const json chart = chart_of(html, "stability-0");
  std::map<std::string, std::string> states;
  for (const json& row : chart["data"]["values"]) {
    states[std::string(row["number"]) + " " + std::string(row["method"])] = row["state"];
    EXPECT_EQ(row["broken"] == "yes", row["method"] == "broken" && row["number"] == "3");
  }
  EXPECT_EQ(states["3 steady"], "refused, as required");
  EXPECT_EQ(states["3 published"], "not a number");
  EXPECT_EQ(states["3 broken"], "out of range");
  EXPECT_EQ(states["8 published"], "off by more");
  EXPECT_EQ(states["8 limited"], "off by less than 1 %");
  EXPECT_EQ(states["8 broken"], "not applicable");
}

TEST(StabilitySection, DrawsBreakingPointsWhereTheyAreKnown) {
  const std::string html = stability_section(testing::synthetic_stability());
  EXPECT_THAT(html, HasSubstr("Against contrast, 2 of 3 samplers fail; required: the sky is kept"));
  const json rows = chart_of(html, "breaking-0")["data"]["values"];
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0]["series"], "passes up to here");
  EXPECT_EQ(rows[0]["interval"], "none up to 1e12");
  EXPECT_EQ(rows[1]["failed"], 1.05e6);
  EXPECT_EQ(rows[2]["interval"], "at 1 already");
}

TEST(StabilitySection, SaysSoIfNothingWasTried) {
  EXPECT_THAT(stability_section({}), HasSubstr("Hard inputs were not tried in this study."));
}

TEST(StabilityLines, AreAMatrixWhatFailedAndAVerdict) {
  const std::vector<std::string> lines = stability_lines(testing::synthetic_stability());
  const auto has = [&](std::string_view text) {
    return std::ranges::any_of(
        lines, [&](const std::string& line) { return line.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(has("steady     r  ."));
  EXPECT_TRUE(has("published  N  W"));
  EXPECT_TRUE(has("limited    .  W"));
  EXPECT_TRUE(has("broken     O  -"));
  EXPECT_TRUE(has("(by its nature: by its nature)"));
  EXPECT_TRUE(has("between 1,000,000 and 1,050,000"));
  EXPECT_EQ(lines.back(), stability_verdict(testing::synthetic_stability()));
}

TEST(StabilityCsv, HasALineForEveryRecord) {
  const StabilityResult stability = testing::synthetic_stability();
  const auto lines = [](const std::string& csv) { return std::ranges::count(csv, '\n'); };
  EXPECT_EQ(lines(stability_csv(stability.records)), 9);
  EXPECT_EQ(lines(breaking_points_csv(stability.breaking_points)), 4);
}

}  // namespace
}  // namespace lightproof
