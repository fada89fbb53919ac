#include "lightproof/report/csv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fixture.h"
#include "lightproof/report/accuracy_tables.h"
#include "lightproof/report/names.h"

namespace lightproof {
namespace {

std::ptrdiff_t lines(const std::string& csv) { return std::count(csv.begin(), csv.end(), '\n'); }

TEST(Csv, HasOneRowPerRecordBelowItsHeading) {
  const StudyResult study = testing::synthetic_study();
  // Every test, and every sampler that was left out.
  EXPECT_EQ(lines(gate_csv(study.gate)), 1 + 696 + 1);
  EXPECT_EQ(lines(convergence_csv(study.convergence)), 1 + 128 * 6);
  EXPECT_EQ(lines(variance_csv(study.convergence)), 1 + 128);
  EXPECT_EQ(lines(throughput_csv(study.throughput)), 1 + 15);
  EXPECT_EQ(lines(build_csv(study.throughput)), 1 + 15);
  EXPECT_EQ(lines(growth_csv(study.growth)), 1 + 3);
  EXPECT_EQ(lines(renders_csv(study.renders)), 1 + 4);
  EXPECT_EQ(lines(split_sum_csv(study.split_sum)), 1 + 96);
  EXPECT_EQ(lines(accuracy_csv(study.accuracy)), 1 + 16 * (6 * 7 + 1));
  EXPECT_EQ(lines(maps_csv(study.maps)), 1 + 8);
}

TEST(Csv, QuotesWhatWouldSplitAField) {
  GateResult gate;
  gate.tests = {testing::accepted_test("a,b", "say \"x\"\nhere")};
  gate.tests[0].log10_p.reset();
  EXPECT_EQ(gate_csv(gate),
            "sampler,density,map,oracle,test,samples,statistic,dof,log10_p,effect,"
            "minimum_detectable_effect,outcome,known_defect,detail\n"
            "\"a,b\",B,\"say \"\"x\"\"\nhere\",reference,bins 16x32,4194304,1031.2,1023,,"
            "0.0157,0.0186,accept,no,\n");
}

TEST(Csv, LetsNoNameBeAFormula) {
  GateResult gate;
  for (const char* name : {"=1+1", "+a", "-b", "@c"}) {
    gate.tests = {testing::accepted_test("alias", name)};
    EXPECT_NE(gate_csv(gate).find(std::string("alias,B,'") + name + ","), std::string::npos)
        << gate_csv(gate);
  }
}

TEST(Csv, LeavesAFieldEmptyWhereThereIsNoBreakpointAndNoCache) {
  std::vector<GrowthFit> growth = testing::synthetic_study().growth;
  EXPECT_NE(growth_csv(growth).find("binary_search,log2 S + log2 T,0.161,0.004,1,0.012,1024x512,"
                                    "4096x2048,0.02,512x256; 1024x512,0.31; 0.12,0.0021\n"),
            std::string::npos)
      << growth_csv(growth);
  EXPECT_NE(growth_csv(growth).find("alias_table,constant,0.052,0.008,1,0.012,1024x512,,,,,\n"),
            std::string::npos)
      << growth_csv(growth);
}

TEST(Csv, RestoresDoublesExactly) {
  ThroughputRecord record{"s", "m", {2, 1}, 0.1 + 0.2, std::nan(""), HUGE_VAL, 0.0, 0.0, 1.5};
  const std::string csv = throughput_csv({record});
  EXPECT_NE(csv.find("s,m,2,1,0.30000000000000004,nan,inf,0,0,1.5\n"), std::string::npos) << csv;
}

TEST(FileNames, AreSafeAndUnique) {
  EXPECT_EQ(file_name_part("../a b"), "_._a_b");
  EXPECT_EQ(file_name_part(""), "_");
  RenderRecord a;
  a.map = "x/y";
  a.receiver = "r";
  a.material = "m";
  a.estimator = "s";
  RenderRecord b = a;
  b.map = "x y";
  EXPECT_EQ(render_stems({a, b}), (std::vector<std::string>{"x_y-r-m-s", "x_y-r-m-s-2"}));
  EXPECT_EQ(render_scenes({a, b}).size(), 2U);
  EXPECT_EQ(render_scenes({a, b})[1].stem, "x_y-r-m-2");
}

}  // namespace
}  // namespace lightproof
