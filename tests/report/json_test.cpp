#include "lightproof/report/json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "fixture.h"

namespace lightproof {
namespace {

using nlohmann::json;

std::set<std::string> keys_of(const json& object) {
  std::set<std::string> keys;
  for (const auto& item : object.items()) keys.insert(item.key());
  return keys;
}

GateResult small_gate() {
  GateResult gate{1e-6, 1000, 42, {testing::accepted_test("binary_search", "city")}};
  TestRecord check = gate.tests[0];
  check.test = TestId::edge_points;
  check.log10_p.reset();
  check.minimum_detectable_effect.reset();
  check.outcome = Outcome::reject;
  gate.tests.push_back(check);
  return gate;
}

json gate_document(const GateResult& gate, Outcome outcome, bool count_known_defects = true) {
  const RunDescription run = {
      "0.1.0", "abc", "lightproof gate city.exr", {R"({"name": "city", "width": 64})"}};
  return json::parse(gate_json(gate, {outcome, count_known_defects}, run));
}

TEST(GateJson, HasItsKeys) {
  const json document = gate_document(small_gate(), Outcome::inconclusive);
  EXPECT_EQ(keys_of(document),
            (std::set<std::string>{"format_version", "version", "commit", "command", "maps",
                                   "outcome", "family_alpha", "samples", "seed", "tests",
                                   "rejections", "known_defects", "recognised", "left_out"}));
  EXPECT_EQ(
      keys_of(document["tests"][0]),
      (std::set<std::string>{"sampler", "density", "map", "oracle", "test", "samples", "statistic",
                             "dof", "log10_p", "effect", "minimum_detectable_effect", "outcome",
                             "known_defect", "stage", "seed", "detail", "resolution_floor"}));
  EXPECT_EQ(document["outcome"], "inconclusive");
  EXPECT_EQ(document["seed"], 42);
  EXPECT_EQ(document["tests"][0]["log10_p"], -0.37);
  EXPECT_EQ(document["tests"][0]["outcome"], "accept");
}

TEST(GateJson, HasNullWhereThereIsNoProbability) {
  const json document = gate_document(small_gate(), Outcome::reject);
  EXPECT_TRUE(document["tests"][1]["log10_p"].is_null());
  EXPECT_TRUE(document["tests"][1]["minimum_detectable_effect"].is_null());
}

TEST(GateJson, WritesWhatIsNotFiniteAsNullOrTheLargestNumber) {
  GateResult gate = small_gate();
  gate.tests[0].log10_p = -HUGE_VAL;
  gate.tests[0].statistic = HUGE_VAL;
  gate.tests[0].effect = std::nan("");
  const json test = gate_document(gate, Outcome::reject)["tests"][0];
  EXPECT_EQ(test["log10_p"], -1e308);
  EXPECT_EQ(test["statistic"], 1e308);
  EXPECT_TRUE(test["effect"].is_null());
}

TEST(GateJson, SaysWhatTheRunWasMadeWith) {
  const json document = gate_document(small_gate(), Outcome::accept);
  EXPECT_EQ(document["commit"], "abc");
  EXPECT_EQ(document["command"], "lightproof gate city.exr");
  EXPECT_EQ(document["maps"], (json{{{"name", "city"}, {"width", 64}}}));
}

TEST(GateJson, KeepsKnownDefectsApartFromRejections) {
  GateResult gate = small_gate();
  for (const char* sampler : {"binary_search", "published"}) {
    gate.rejections.push_back({.sampler = sampler,
                               .density_space = "B",
                               .map = "city",
                               .looks_like = "row",
                               .diagnosis = "a row is dark",
                               .residual = {},
                               .row_divergence = {}});
  }
  TestRecord published = gate.tests[1];
  published.sampler = "published";
  published.known_defect = true;
  gate.tests.push_back(published);
  const json apart = gate_document(gate, Outcome::accept, false);
  ASSERT_EQ(apart["rejections"].size(), 1U);
  EXPECT_EQ(apart["rejections"][0]["sampler"], "binary_search");
  ASSERT_EQ(apart["known_defects"].size(), 1U);
  EXPECT_EQ(apart["known_defects"][0]["sampler"], "published");
  const json together = gate_document(gate, Outcome::reject, true);
  EXPECT_EQ(together["rejections"].size(), 2U);
  EXPECT_TRUE(together["known_defects"].empty());
}

TEST(GateJson, HasNoDegreesOfFreedomWhereTheyMeanNothing) {
  GateResult gate = small_gate();
  gate.tests[0].dof = 0.0;
  EXPECT_TRUE(gate_document(gate, Outcome::accept)["tests"][0]["dof"].is_null());
}

TEST(GateJson, SurvivesNamesThatAreNotUtf8) {
  GateResult gate = small_gate();
  gate.tests[0].map = "bad\xff name";
  EXPECT_EQ(gate_document(gate, Outcome::accept)["tests"][0]["map"], "bad\ufffd name");
}

TEST(StudyJson, HoldsEverythingButThePixels) {
  const json document = json::parse(study_json(testing::synthetic_study(), {}));
  EXPECT_EQ(keys_of(document), (std::set<std::string>{"format_version",
                                                      "version",
                                                      "commit",
                                                      "command",
                                                      "machine",
                                                      "seed",
                                                      "maps",
                                                      "gate",
                                                      "convergence",
                                                      "accuracy",
                                                      "recommendations",
                                                      "refused_recommendations",
                                                      "recommendation_survey",
                                                      "method_regimes",
                                                      "throughput",
                                                      "throughput_origin",
                                                      "directions_origin",
                                                      "caches",
                                                      "growth",
                                                      "tables",
                                                      "directions",
                                                      "renders",
                                                      "self_test",
                                                      "published_forms",
                                                      "published_pictures",
                                                      "split_sum",
                                                      "frames",
                                                      "points",
                                                      "level_costs",
                                                      "stability"}));
  EXPECT_EQ(document["maps"].size(), 8U);
  EXPECT_EQ(document["maps"][0]["size"], (json{64, 32}));
  EXPECT_EQ(document["maps"][0]["drawn"].size(), 300U);
  EXPECT_EQ(document["convergence"].size(), 128U);
  EXPECT_EQ(document["convergence"][0]["points"].size(), 6U);
  EXPECT_EQ(document["renders"][1]["picture"], "city-sphere-GGX__roughness_0.3-brdf.exr");
  EXPECT_EQ(document["renders"][1]["reference"], "city-sphere-GGX__roughness_0.3-reference.exr");
}

TEST(StudyJson, HoldsTheSplitSumAndTheErrorsOfPictures) {
  const json document = json::parse(study_json(testing::synthetic_study(), {}));
  EXPECT_EQ(document["published_pictures"][0], (json{{"system", "004-2"},
                                                     {"what", "a sphere <for a test>"},
                                                     {"size", {32, 24}},
                                                     {"published_rmse", 8.8},
                                                     {"corrected_rmse", 0.02},
                                                     {"noise", 0.011}}));
  ASSERT_EQ(document["split_sum"].size(), 96U);
  EXPECT_EQ(document["split_sum"][1]["map"], "city");
  EXPECT_NEAR(document["split_sum"][1]["view_degrees"].get<double>(), 80.0, 1e-12);
  EXPECT_NEAR(document["split_sum"][1]["rmse"].get<double>(), 0.1, 1e-12);
  EXPECT_NEAR(document["split_sum"][1]["left_out"].get<double>(), 0.08, 1e-12);
}

TEST(StudyJson, HasCachesAndBreakpointsOrNull) {
  StudyResult study = testing::synthetic_study();
  study.caches.l3.reset();
  const json document = json::parse(study_json(study, {}));
  EXPECT_EQ(document["caches"], (json{{"l2", 1048576.0}, {"l3", nullptr}}));
  const json& growth = document["growth"];
  EXPECT_EQ(growth[0]["leaves_l3"], (json{4096, 2048}));
  EXPECT_EQ(growth[0]["segmented"]["exponent_before"], 0.02);
  EXPECT_EQ(growth[0]["segmented"]["breakpoints"][1],
            (json{{"size", {1024, 512}}, {"exponent_after", 0.12}}));
  EXPECT_EQ(growth[0]["segmented"]["p_value"], 0.0021);
  EXPECT_EQ(growth[0]["build_exponent"], (json{{"value", 1.0}, {"error", 0.012}}));
  EXPECT_TRUE(growth[1]["leaves_l3"].is_null());
  EXPECT_TRUE(growth[1]["segmented"].is_null());
}

TEST(StudyJson, DoesNotCountKnownDefects) {
  const StudyResult study = testing::synthetic_study();
  EXPECT_EQ(json::parse(study_json(study, {}))["gate"]["outcome"], "accept");
}

}  // namespace
}  // namespace lightproof
