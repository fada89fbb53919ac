#include "lightproof/report/charts.h"
#include "lightproof/report/directions_figure.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "fixture.h"

namespace lightproof {
namespace {

using nlohmann::json;

TEST(SeriesStyles, DifferInColourAndInShape) {
  std::vector<std::string> names;
  for (char c = 'a'; c < 'i'; ++c) names.emplace_back(1, c);
  names.emplace_back("a");
  const std::vector<SeriesStyle> styles = series_styles(names);
  ASSERT_EQ(styles.size(), 8U);
  std::set<std::string> colours;
  std::set<std::string> shapes;
  for (const SeriesStyle& style : styles) {
    colours.insert(style.colour);
    shapes.insert(style.shape);
  }
  EXPECT_EQ(colours.size(), 8U);
  EXPECT_EQ(shapes.size(), 8U);
}

TEST(ConvergenceChart, HasEveryPointAndAListOfMapsAndScenes) {
  const json chart = json::parse(convergence_chart(testing::synthetic_study().convergence));
  EXPECT_EQ(chart["data"]["values"].size(), 128U * 6U);
  ASSERT_EQ(chart["params"].size(), 2U);
  EXPECT_EQ(chart["params"][0]["bind"]["options"].size(), 8U);
  EXPECT_EQ(chart["params"][1]["bind"]["options"].size(), 4U);
}

TEST(ConvergenceChart, OffersOnlyWhatWasMeasured) {
  StudyResult study = testing::synthetic_study();
  study.convergence.resize(21);  // two maps, one of them with two of the four scenes
  const json chart = json::parse(convergence_chart(study.convergence));
  ASSERT_EQ(chart["params"].size(), 1U);
  EXPECT_EQ(chart["params"][0]["bind"]["options"].size(), 6U);
}

TEST(ConvergenceChart, LeavesOutWhatALogarithmCannotShow) {
  StudyResult study = testing::synthetic_study();
  study.convergence.resize(4);
  study.convergence[0].measured_variance = 0.0;  // all but exact
  study.convergence[0].predicted_variance = 1e-10;
  study.convergence[1].points[0].rmse = 0.0;
  study.convergence[1].points[1].predicted = 0.0;
  study.convergence[1].points[2].rmse_error = 100.0;
  const json rows = json::parse(convergence_chart(study.convergence))["data"]["values"];
  EXPECT_EQ(rows.size(), 3U * 6U - 1U);
  EXPECT_TRUE(rows[0]["predicted"].is_null());
  for (const json& row : rows) EXPECT_GT(row["drawn_low"].get<double>(), 0.0);
}

TEST(SmallConvergenceCharts, ShareTheirAxis) {
  const auto records = testing::synthetic_study().convergence;
  const std::string scene = scene_name(records[0]);
  const json a = json::parse(small_convergence_chart(records, "city", scene));
  const json b = json::parse(small_convergence_chart(records, "night", scene));
  const auto domain = [](const json& chart) {
    return chart["layer"][0]["encoding"]["y"]["scale"]["domain"];
  };
  EXPECT_EQ(a["data"]["values"].size(), 4U * 6U);
  EXPECT_EQ(domain(a), domain(b));
}

TEST(VarianceChart, HasBarsOfTwoStandardErrors) {
  auto records = testing::synthetic_study().convergence;
  records.resize(2);
  records[0].predicted_variance = 2.0;
  records[0].measured_variance = 2.2;
  records[0].variance_ratio_error = 0.03;
  records[1].predicted_variance = 0.0;
  const json rows = json::parse(variance_chart(records))["data"]["values"];
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_DOUBLE_EQ(rows[0]["ratio"], 1.1);
  EXPECT_DOUBLE_EQ(rows[0]["low"], 1.04);
  EXPECT_DOUBLE_EQ(rows[0]["high"], 1.16);
}

std::vector<std::string> names_of(const std::vector<TableRecord>& records) {
  std::vector<std::string> names;
  for (const TableRecord& record : records) names.push_back(record.sampler);
  return names;
}

TEST(UnbeatenTables, AreThoseThatNothingBeatsInTimeSizeAndErrorAtOnce) {
  EXPECT_EQ(names_of(unbeaten_tables(testing::synthetic_study().tables)),
            (std::vector<std::string>{"packed_alias", "alias", "guide_table", "alias_lines",
                                      "binary_search"}));
}

TEST(TableChart, MarksWhatIsNotBeatenOnTheLargestMap) {
  std::vector<TableRecord> tables = testing::synthetic_study().tables;
  tables.push_back({"small map", "sun-sky", {4, 2}, 1.0, 1.0, 1e-9, 99.0, 1.0});
  const json rows = json::parse(table_chart(tables))["data"]["values"];
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[0]["series"], "upper_bound_baseline");
  EXPECT_EQ(rows[0]["front"], "beaten in all three");
  EXPECT_EQ(rows[3]["series"], "alias_lines");
  EXPECT_EQ(rows[3]["front"], "not beaten");
  EXPECT_EQ(rows[4]["accuracy"], "below 1e-5");
}

TEST(DirectionsFigure, SaysHowFastBatchesAndSinglesAreAndHowDensitiesDiffer) {
  std::vector<DirectionRecord> records = testing::synthetic_study().directions;
  const Extent extent = {2048, 1024};
  const std::size_t count = records.size();
  // Of another size, and faster than all: it has a chart of its own.
  records.push_back(
      {"packed_alias", "sun-sky", {8192, 4096}, "B", DrawOrder::fused, 1.0, 99.0, 0.9});
  EXPECT_EQ(
      directions_finding(records, extent),
      "On 2048\u00d71024 in batches packed_alias draws a direction 50 times as fast as the usual "
      "way, one at a "
      "time packed_alias 7.5 times; of packed_alias, B takes 1.10 and C 1 times as long as A");
  const json chart = json::parse(directions_chart(records, extent));
  ASSERT_EQ(chart["data"]["values"].size(), count);
  EXPECT_EQ(chart["data"]["values"][2]["busy"], "quiet");
  EXPECT_EQ(chart["data"]["values"][3]["busy"], "busy");
  const std::string figure = directions_figure(records);
  EXPECT_NE(figure.find("directions-chart-2048"), std::string::npos);
  EXPECT_NE(figure.find("On 8192\u00d74096 in batches packed_alias draws a direction 99 times"),
            std::string::npos);
  EXPECT_NE(figure.find("busy, 1.3"), std::string::npos);
  for (const json& layer : chart["layer"]) {
    EXPECT_EQ(layer["encoding"]["color"]["field"], "density");
  }
  EXPECT_EQ(chart["layer"][1]["transform"][0]["filter"], "datum.busy === 'busy'");
  EXPECT_FALSE(chart["layer"][1]["mark"]["filled"]) << "hollow";
  EXPECT_EQ(directions_figure({}), "");
}

TEST(ThroughputChart, NamesTheExponents) {
  const json rows = json::parse(throughput_chart(testing::synthetic_study()))["data"]["values"];
  ASSERT_EQ(rows.size(), 15U);
  EXPECT_EQ(rows[0]["series"], "binary_search, exponent 0.16");
  EXPECT_EQ(rows[0]["size"], 384.0);
  EXPECT_EQ(rows[0]["extent"], "256\u00d7128");
}

/// "extent sampler" of the points in a frame.
std::vector<std::string> framed(const json& chart, const std::string& name) {
  std::vector<std::string> points;
  for (const json& row : chart["layer"].at(3)["data"]["values"]) {
    if (row["series"] != name) continue;
    points.push_back(row["extent"].get<std::string>() + " " + row["sampler"].get<std::string>());
  }
  return points;
}

TEST(ThroughputChart, FramesThePointsBeyondACacheAndTheBreakpoints) {
  const json chart = json::parse(throughput_chart(testing::synthetic_study()));
  EXPECT_EQ(framed(chart, "first table beyond L2 (1\u00a0MiB)"),
            (std::vector<std::string>{"1024\u00d7512 binary_search",
                                      "1024\u00d7512 linear_scan_published",
                                      "1024\u00d7512 alias_table"}));
  EXPECT_EQ(framed(chart, "first table beyond L3 (32\u00a0MiB)"),
            std::vector<std::string>{"4096\u00d72048 binary_search"});
  EXPECT_EQ(
      framed(chart, "measured breakpoint of the time of a step"),
      (std::vector<std::string>{"512\u00d7256 binary_search", "1024\u00d7512 binary_search"}));
  const json names = chart["layer"][2]["encoding"]["shape"]["scale"]["domain"];
  EXPECT_EQ(names.size(), 3U + 3U) << "the legend has the samplers and the frames";
}

TEST(ThroughputChart, HasNoFramesWhereNothingIsKnown) {
  StudyResult study = testing::synthetic_study();
  study.growth.clear();
  EXPECT_EQ(json::parse(throughput_chart(study))["layer"].size(), 3U);
}

TEST(ThroughputChart, ShowsTheFastestTheSlowestAndTheUsualSamplerFirst) {
  StudyResult study = testing::synthetic_study();
  study.throughput.push_back({"middling", "sun-sky", {4096, 2048}, 40.0, 39.0, 41.0, 1.0, 1.0});
  std::set<std::string> leading;
  const json rows = json::parse(throughput_chart(study))["data"]["values"];
  for (const json& row : rows) {
    if (row["leads"]) leading.insert(row["sampler"]);
  }
  EXPECT_EQ(leading,
            (std::set<std::string>{"alias_table", "binary_search", "linear_scan_published"}));
}

TEST(ConvergenceChart, OpensWhereMostSlopesCouldBeFitted) {
  auto records = testing::synthetic_study().convergence;
  for (ConvergenceRecord& r : records) {
    if (r.map != "forest") r.slope = std::nan("");
  }
  const json chart = json::parse(convergence_chart(records));
  EXPECT_EQ(chart["params"][0]["value"], "forest");
  const std::vector<ChartTitle> titles = convergence_titles(records);
  EXPECT_EQ(titles.size(), 8U * 4U);
  EXPECT_TRUE(titles[0].title.starts_with("forest, point up, Lambert: All 4 estimators fall"))
      << titles[0].title;
  EXPECT_EQ(titles[0].key, "forest | point up, Lambert");
}

TEST(VarianceChart, MakesPaleWhatSaysLittle) {
  auto records = testing::synthetic_study().convergence;
  records.resize(2);
  records[0].variance_ratio_error = 0.34;
  const json rows = json::parse(variance_chart(records))["data"]["values"];
  EXPECT_FALSE(rows[0]["counts"].get<bool>());
  EXPECT_TRUE(rows[1]["counts"].get<bool>());
}

}  // namespace
}  // namespace lightproof
