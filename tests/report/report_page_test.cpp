#include "lightproof/report/report_page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "fixture.h"
#include "lightproof/core/error.h"
#include "lightproof/report/report.h"
#include "lightproof/report/sections.h"

namespace lightproof {
namespace {
namespace fs = std::filesystem;

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(Page, NeverContainsTheMarkupOfANameAsMarkup) {
  const std::string page = report_page(testing::synthetic_study());
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;alert(&quot;x&quot;)&lt;/script&gt;"), std::string::npos);
  EXPECT_EQ(occurrences(page, "<script"), occurrences(page, "</script>"));
}

TEST(Page, NeedsNothingFromOutside) {
  const std::string page = report_page(testing::synthetic_study());
  static const std::regex reference_mark(R"((src|href)="(?!data:|#))");
  EXPECT_FALSE(std::regex_search(page.substr(0, page.find("<script>!function")), reference_mark));
  EXPECT_EQ(page.find("sourceMappingURL"), std::string::npos);
  EXPECT_NE(page.find("Redistribution"), std::string::npos) << "licence texts are missing";
}

TEST(Page, SaysWhatWasNotMeasured) {
  StudyResult study = testing::synthetic_study();
  study.throughput.clear();
  study.renders.clear();
  study.convergence.clear();
  study.gate.tests.clear();
  study.maps.clear();
  study.split_sum.clear();
  study.self_test.reset();
  study.frames.clear();
  study.points = {};
  study.level_costs = {};
  study.stability = {};
  study.accuracy.clear();
  study.recommendations.clear();
  study.refused_recommendations.clear();
  study.method_regimes = {};
  const std::string page = report_page(study);
  EXPECT_NE(page.find("Throughput was not measured in this study. Build"), std::string::npos);
  EXPECT_EQ(page.find("<figure class=\"chart"), std::string::npos) << "an empty chart";
  EXPECT_NE(page.find("<h1>No test was run</h1>"), std::string::npos);
}

TEST(Page, SaysInWhichTexelsAMapIsDrawnAndJudgedAndWhatTheseLeaveOut) {
  const std::string page = report_page(testing::synthetic_study());
  EXPECT_EQ(occurrences(page, "The file has other texels (32\u00d732, octahedral)"), 1U);
  EXPECT_EQ(occurrences(page, "\u2013 left out"), 1U);
  EXPECT_EQ(occurrences(page, "no such look-up on its texels"), 2U)
      << "beside the cell, in the list";
}

TEST(Page, ShowsKnownDefectsInASectionOfTheirOwn) {
  const std::string page = report_page(testing::synthetic_study());
  const std::size_t section = page.find("<summary>Kept as published, with known defects");
  ASSERT_NE(section, std::string::npos);
  EXPECT_GT(page.find("<h4>Rejected tests</h4>"), section);
  EXPECT_NE(page.find("<strong class=\"demonstration\">as known</strong> "
                      "<span>linear_scan_published"),
            std::string::npos);
}

TEST(Page, SaysHowOftenADefectIsCalledByItsName) {
  const std::string page = report_page(testing::synthetic_study());
  EXPECT_NE(
      page.find("Of 88 rejections of injected defects on the maps of this study, 95\u00a0% are "
                "called by their right name, 2.3\u00a0% by a wrong one, and of 2.3\u00a0% the"),
      std::string::npos);
  EXPECT_NE(page.find("2 (uneven-in-texel)"), std::string::npos);
}

TEST(Report, FoldsEstimatorsThatStandForNoKindTheLeastErrorFirst) {
  StudyResult study = testing::synthetic_study();
  ASSERT_EQ(study.renders.size(), 4U);
  const std::string unfolded = render_section(study.renders);
  EXPECT_EQ(unfolded.find("Others in the same time"), std::string::npos);
  study.renders[1].is_representative = study.renders[3].is_representative = false;
  study.renders[1].rmse = 0.3;
  study.renders[3].rmse = 0.1;
  const std::string html = render_section(study.renders);
  const auto caption = [&](std::size_t i) {
    return html.find("<strong>" + study.renders[i].estimator + "</strong>");
  };
  const std::size_t fold =
      html.find("Others in the same time, the least error first: 2 estimators");
  EXPECT_LT(std::max(caption(0), caption(2)), fold);
  EXPECT_LT(fold, caption(3));
  EXPECT_LT(caption(3), caption(1));
  EXPECT_NE(caption(1), std::string::npos);
}

TEST(Report, WritesAllItsFiles) {
  const fs::path folder = fs::path(::testing::TempDir()) / "lightproof-report" / "new";
  fs::remove_all(folder);
  write_report(testing::synthetic_study(), folder);
  for (const char* name :
       {"report.html", "results.json", "gate.csv", "convergence.csv", "variance.csv",
        "throughput.csv", "growth.csv", "build.csv", "tables.csv", "directions.csv", "renders.csv",
        "maps.csv", "split_sum.csv", "manifest.json", "city-sphere-GGX__roughness_0.3-uniform.exr",
        "city-sphere-GGX__roughness_0.3-uniform-error.exr",
        "city-sphere-GGX__roughness_0.3-reference.exr"}) {
    EXPECT_TRUE(fs::exists(folder / name) && fs::file_size(folder / name) > 0) << name;
  }
  fs::remove_all(folder.parent_path());
}

TEST(Report, RefusesAFolderThatCannotBe) {
  try {
    write_report({}, "/dev/null/report");
    FAIL() << "written";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/dev/null/report: cannot create the folder"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace lightproof
