#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "fixture.h"
#include "lightproof/report/accuracy_blocks.h"
#include "lightproof/report/accuracy_charts.h"
#include "lightproof/report/accuracy_findings.h"
#include "lightproof/report/sections.h"
#include "tests/results/accuracy_lines.h"

namespace lightproof {
namespace {

using nlohmann::json;
using testing::chart_of;
using testing::falling;
using testing::look_up;

TEST(FrontSentence, GoesFromFastToExact) {
  EXPECT_EQ(
      front_sentence(chart_of({falling("a", EstimatorFamily::lobes), look_up("c", 1e-7, 0.3)})),
      "On the front, from fast to exact: c (100\u00a0ns, 30\u00a0%); a "
      "(16\u00a0\u00b5s, 25\u00a0%).");
}

TEST(AccuracyFinding, NamesTheFastestToEachErrorAndTheHandicapOfUniform) {
  EXPECT_EQ(accuracy_finding(
                chart_of({falling("uniform", EstimatorFamily::uniform, 0.2),
                          falling("b", EstimatorFamily::mis, 0.0245), look_up("c", 1e-7, 0.04)})),
            "5\u00a0% error takes 100\u00a0ns (c), 1\u00a0% error takes 6.0\u00a0\u00b5s (b, 7 "
            "samples); to 5\u00a0% uniform sampling takes 160 times as long");
  EXPECT_EQ(accuracy_finding(chart_of({falling("uniform", EstimatorFamily::uniform, 9.0)})),
            "5\u00a0% error is reached by none");
}

TEST(AccuracyCaveats, SayWhatIsPredictedAndWhatIgnoresOcclusion) {
  AccuracyChart chart = chart_of({falling("a", EstimatorFamily::lobes)});
  EXPECT_EQ(accuracy_caveats(chart), "1 estimator, 24 shading points, quality draft.");
  chart.lines[0].points[0].rmse_error = 0.6;
  chart.is_occluded = true;
  const std::string text = accuracy_caveats(chart);
  EXPECT_NE(text.find("At 1 point the error is carried by rare hits"), std::string::npos) << text;
  EXPECT_NE(text.find("blocks the light"), std::string::npos) << text;
}

TEST(SlopeFinding, SetsTheAliasTableAgainstTheMonotoneOne) {
  AccuracyLine monotone = falling("environment B sobol", EstimatorFamily::points);
  AccuracyLine alias = falling("environment B alias sobol", EstimatorFamily::points);
  monotone.slope = -0.8;
  alias.slope = -0.5;
  monotone.slope_error = alias.slope_error = 0.01;
  const std::string finding =
      "sobol points fall with \u22120.800 \u00b1 0.010 by the monotone table and with "
      "\u22120.500 \u00b1 0.010 by the alias table";
  EXPECT_EQ(slope_finding(chart_of({monotone, alias})), finding);
  AccuracyLine even = falling("environment B R2", EstimatorFamily::points);
  AccuracyLine even_alias = falling("environment B alias R2", EstimatorFamily::points);
  even.slope = even_alias.slope = -0.6;
  even.slope_error = even_alias.slope_error = 0.01;
  EXPECT_EQ(slope_finding(chart_of({even, even_alias, monotone, alias})),
            finding + ": the largest difference of 2 sets");
}

AccuracyLine table_of(const char* name, std::size_t bytes, double scale) {
  AccuracyLine line = falling(name, EstimatorFamily::environment, scale);
  line.bytes = bytes;
  return line;
}

TEST(MemoryFinding, NamesTheSmallestTableThatIsAsGood) {
  const AccuracyLine whole = table_of("whole", 8U << 20U, 1.0);
  EXPECT_EQ(memory_finding(chart_of({whole, table_of("quarter", 512U << 10U, 1.05),
                                     table_of("sixteenth", 32U << 10U, 1.5)})),
            "At 64 samples quarter (512\u00a0KiB, 13\u00a0%) is as good as whole (8\u00a0MiB, "
            "12\u00a0%)");
  EXPECT_EQ(
      memory_finding(chart_of({whole, table_of("sixteenth", 32U << 10U, 1.5)})),
      "At 64 samples no smaller table of the map is as good as whole (8\u00a0MiB, 12\u00a0%)");
  EXPECT_EQ(memory_finding(chart_of({falling("a", EstimatorFamily::environment)})),
            "Error against memory");
}

TEST(MemoryChart, HasWhatKeepsMemoryAt64SamplesOrAsItIs) {
  AccuracyLine kept = look_up("map", 1e-7, 0.3);
  kept.bytes = 4096;
  AccuracyLine predicted = table_of("b", 1024, 2.0);
  for (AccuracyPoint& point : predicted.points) point.predicted = 1.1 * point.rmse;
  const json rows = json::parse(memory_chart(
      {chart_of({falling("a", EstimatorFamily::mis), predicted, kept})}))["data"]["values"];
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]["estimator"], "b");
  EXPECT_EQ(rows[0]["rmse"], 0.25);
  EXPECT_EQ(rows[0]["predicted"], 0.275);
  EXPECT_EQ(rows[1]["bytes"], 4096.0);
  EXPECT_EQ(rows[1]["rmse"], 0.3);
  EXPECT_TRUE(rows[1]["predicted"].is_null());
  EXPECT_EQ(memory_chart({chart_of({falling("a", EstimatorFamily::mis)})}), "");
}

TEST(AccuracyChartSpec, MarksWhatLeadsAndDashesWhatIsPredicted) {
  AccuracyLine rare = falling("uniform", EstimatorFamily::uniform, 30.0);
  for (AccuracyPoint& point : rare.points) point.predicted = 1.1 * point.rmse;
  rare.points[0].rmse_error = rare.points[0].rmse;
  const json spec = json::parse(accuracy_chart(
      {chart_of({rare, falling("a", EstimatorFamily::mis), falling("b", EstimatorFamily::mis, 2.0),
                 look_up("c", 1e-7, 0.3)})}));
  json of_rare;
  json of_b;
  for (const json& row : spec["data"]["values"]) {
    if (row.value("series", "") == "uniform") of_rare.push_back(row);
    if (row.value("series", "") == "b") of_b.push_back(row);
  }
  ASSERT_EQ(of_rare.size(), 4U);
  EXPECT_TRUE(of_rare[0]["rmse"].is_null());
  EXPECT_EQ(of_rare[0]["predicted"], 10.0) << "drawn on the edge";
  EXPECT_FALSE(of_rare[2]["predicted"].is_null()) << "beside what was measured";
  EXPECT_TRUE(of_rare[0]["leads"][0]);
  EXPECT_FALSE(of_b[0]["leads"][0]);
}

// What is the fastest with its set-up for nothing is not if 100 points pay for it.
TEST(AccuracyChartSpec, HasAFrontForEachShareOfTheSetUp) {
  AccuracyLine prepared = look_up("c", 1e-7, 0.3);
  prepared.set_up_processor_seconds = 1.0;
  const json spec =
      json::parse(accuracy_chart({chart_of({falling("a", EstimatorFamily::mis), prepared})}));
  std::vector<double> first(4, HUGE_VAL);
  json leads;
  for (const json& row : spec["data"]["values"]) {
    if (row.contains("front")) {
      double& seconds = first.at(row["choice"].get<std::size_t>());
      seconds = std::min(seconds, row["seconds"].get<double>());
    }
    if (row.value("series", "") == "c" && row.contains("n")) leads = row["leads"];
  }
  EXPECT_DOUBLE_EQ(first[0], 1e-7);
  EXPECT_GT(first[3], 1e-7) << "a shading point's share is 10 ms";
  EXPECT_EQ(spec["transform"][1]["calculate"],
            "datum.seconds + [0.0,1e-06,0.0001,0.01][set_up] * datum.setup");
  EXPECT_TRUE(leads[0]);
}

TEST(AccuracyChartSpec, OffersEveryMapReceiverAndMaterial) {
  const std::vector<AccuracyChart> charts = testing::synthetic_study().accuracy;
  const json spec = json::parse(accuracy_chart(charts));
  ASSERT_EQ(spec["params"].size(), 4U);
  EXPECT_EQ(spec["params"][3]["bind"]["labels"].size(),
            spec["params"][3]["bind"]["options"].size());
  EXPECT_EQ(spec["params"][0]["bind"]["options"].size(), 8U);
  EXPECT_EQ(spec["params"][1]["value"], "sphere") << "the receiver that nothing occludes";
}

TEST(SceneChoice, OffersWholePlacesWhereCombinationsAreMissing) {
  const std::vector<SceneKey> scenes = {{"a", "x"}, {"a", "y"}, {"b", "x"}};
  const SceneChoice choice({{"map", "Map"}, {"scene", "Scene"}}, scenes, scenes[2]);
  const json params = choice.params();
  ASSERT_EQ(params.size(), 1U);
  EXPECT_EQ(params[0]["value"], "b, x");
  EXPECT_EQ(choice.key(scenes[1]), "a, y");
  const SceneChoice full({{"map", "Map"}, {"scene", "Scene"}},
                         {{"a", "x"}, {"a", "y"}, {"b", "x"}, {"b", "y"}}, {"b", "y"});
  EXPECT_EQ(full.params().size(), 2U);
  EXPECT_EQ(full.key({"a", "y"}), "a | y");
}

TEST(RegimeChart, ShowsTheFastestAndTheFastestWithoutBias) {
  const MethodRegimes regimes = testing::synthetic_study().method_regimes;
  EXPECT_EQ(regime_finding(regimes),
            "Fastest to 5\u00a0% error over 6 pairs of light and roughness: split-sum in 3, "
            "environment B in 3");
  const json rows = json::parse(regime_chart(regimes))["data"]["values"];
  ASSERT_EQ(rows.size(), 12U);
  EXPECT_EQ(rows[0]["series"], "split-sum");
  EXPECT_EQ(rows[6]["series"], "brdf");
  EXPECT_EQ(rows[7]["series"], "none");
}

TEST(AccuracyTables, NameWhatWasLeftOutAndWhy) {
  const std::string html = accuracy_tables_html(testing::synthetic_study().accuracy[0]);
  EXPECT_NE(html.find("1 estimator left out, and why"), std::string::npos);
  EXPECT_NE(html.find("it does not serve this material"), std::string::npos);
}

TEST(RecommendationSection, HasARowForEachMapOrWhatWasMeasured) {
  StudyResult study = testing::synthetic_study();
  const std::string recommended = recommendation_section(study);
  EXPECT_NE(recommended.find("environment B alias, 64 samples, for 5\u00a0% error"),
            std::string::npos);
  EXPECT_NE(recommended.find("its floor is 8 %"), std::string::npos);
  EXPECT_NE(recommended.find("table 512\u00d7256"), std::string::npos);
  EXPECT_NE(recommended.find("no method reaches 5\u00a0% error"), std::string::npos);
  EXPECT_NE(recommended.find("brdf needs 2e+05 samples, of 65536 at most"), std::string::npos);
  study.recommendations.clear();
  EXPECT_NE(recommendation_section(study).find("no method reaches"), std::string::npos);
  study.refused_recommendations.clear();
  const std::string measured = recommendation_section(study);
  EXPECT_NE(measured.find("as it was measured here"), std::string::npos);
  study.accuracy.clear();
  EXPECT_EQ(recommendation_section(study), "");
}

TEST(RecommendationSection, ShowsHowGoodAnswersAreWithTheMapsApart) {
  StudyResult study = testing::synthetic_study();
  const std::string html = recommendation_section(study);
  const auto has = [&](const char* text) { return html.find(text) != std::string::npos; };
  EXPECT_TRUE(has("looked at while building"));
  EXPECT_TRUE(has("100\u00a0% (goal: 95\u00a0%)"));
  EXPECT_TRUE(has("0\u00a0% (goal: 90\u00a0%)"));  // the one on the other map takes twice as long
  EXPECT_TRUE(has("The worst cases"));
  EXPECT_TRUE(has("sh-9"));
  study.recommendation_survey.reset();
  EXPECT_EQ(recommendation_section(study).find("goal: 95"), std::string::npos);
}

}  // namespace
}  // namespace lightproof
