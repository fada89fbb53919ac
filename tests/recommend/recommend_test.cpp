// Which methods are candidates, and what is recommended of them.
#include "lightproof/recommend/recommend.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/recommend/survey.h"

namespace lightproof {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr Extent kMap = {256, 128};
constexpr Extent kSmall = {128, 64};

MethodCost cost_of(const char* estimator, double set_up, double bytes, double seconds) {
  return {estimator, set_up, bytes, {1, 100}, {seconds, 100.0 * seconds}};
}

MethodCosts costs_of(std::vector<MethodCost> costs) { return {costs, costs}; }

EstimatorPrediction predicted(const char* estimator, ErrorModel model, double variance,
                              double bias) {
  return {estimator_by_name(estimator).name, PredictedError{model, variance, bias}, ""};
}

std::vector<std::string> names_of(const Candidates& candidates) {
  std::vector<std::string> names;
  for (const Candidate& candidate : candidates.possible) names.emplace_back(candidate.info->name);
  return names;
}

/// An unbiased method of 1 us a sample, a slower and a biased one.
struct Choice {
  MethodCosts costs =
      costs_of({cost_of("environment B", 0.1, 4e6, 1e-6), cost_of("brdf", 0.0, 0.0, 1e-6),
                cost_of("sh-9", 1.0, 200.0, 3e-8)});
  Prediction prediction = {1.0,
                           {predicted("environment B", ErrorModel::independent, 1.0, 0.0),
                            predicted("brdf", ErrorModel::independent, 4.0, 0.0),
                            predicted("sh-9", ErrorModel::constant, 0.0, 0.03)}};

  Candidates of(const MethodDemand& demand) const {
    return candidates_for(demand, prediction, costs, kMap);
  }
};

TEST(SamplesFor, AreTheVarianceOverWhatTheBiasLeaves) {
  const EstimatorInfo& one = estimator_by_name("environment B");
  EXPECT_EQ(samples_for(one, {ErrorModel::independent, 1.0, 0.0}, 0.1), 100U);
  EXPECT_EQ(samples_for(one, {ErrorModel::independent, 1.001, 0.0}, 0.1), 101U);
  EXPECT_EQ(samples_for(one, {ErrorModel::independent, 1.0, 0.06}, 0.1), 157U);  // 1 / .0064
  EXPECT_EQ(samples_for(one, {ErrorModel::independent, 1.0, 0.1}, 0.1), std::nullopt);
  EXPECT_EQ(samples_for(one, {ErrorModel::independent, 0.0, 0.0}, 0.1), 1U);
  EXPECT_EQ(
      samples_for(estimator_by_name("mis balance"), {ErrorModel::independent, 1.001, 0.0}, 0.1),
      102U);
  EXPECT_EQ(samples_for(one, {ErrorModel::constant, 0.0, 0.09}, 0.1), 1U);
  EXPECT_EQ(samples_for(one, {ErrorModel::constant, 0.0, 0.11}, 0.1), std::nullopt);
}

TEST(MethodCost, LiesOnStraightLinesOfLogarithms) {
  const MethodCost cost = {"", 0.0, 0.0, {1, 4, 16}, {1.0, 2.0, 8.0}};
  EXPECT_NEAR(cost.seconds_of(1), 1.0, 1e-12);
  EXPECT_NEAR(cost.seconds_of(2), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(cost.seconds_of(8), 4.0, 1e-12);
  EXPECT_NEAR(cost.seconds_of(32), 16.0, 1e-12);
  EXPECT_EQ((MethodCost{"", 0.0, 0.0, {1}, {3.0}}).seconds_of(1000), 3.0);
}

TEST(MethodCosts, GrowWithTheMapAsPowers) {
  const MethodCosts costs = {{cost_of("brdf", 1.0, 8.0, 1.0)}, {cost_of("brdf", 16.0, 8.0, 2.0)}};
  // Costs are measured on 256 x 128 and on sixteen times as many texels.
  EXPECT_NEAR(costs.of("brdf", {512, 256})->set_up_seconds, 4.0, 1e-12);
  EXPECT_NEAR(costs.of("brdf", {512, 256})->seconds_of(1), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(costs.of("brdf", {2048, 1024})->set_up_seconds, 64.0, 1e-9);
  EXPECT_FALSE(costs.of("sh-9", kMap));
}

TEST(Candidates, ComeCheapestFirst) {
  const Choice choice;
  EXPECT_EQ(names_of(choice.of({.error = 0.05, .budget_seconds = 5e-3})),
            (std::vector<std::string>{"sh-9", "environment B", "brdf"}));
  EXPECT_EQ(names_of(choice.of({.error = 0.02, .budget_seconds = 5e-3})),
            (std::vector<std::string>{"environment B"}));  // brdf takes 10 ms a point
}

TEST(Candidates, ShareOutTheSetUpOverTheShadingPoints) {
  const Choice choice;
  EXPECT_EQ(names_of(choice.of({.error = 0.1, .budget_seconds = 1.0, .shading_points = 100})),
            (std::vector<std::string>{"brdf", "environment B", "sh-9"}));
}

TEST(Candidates, KeepBudgetAndMemory) {
  const Choice choice;
  EXPECT_EQ(names_of(choice.of({.error = 0.05, .budget_seconds = 5e-4})),
            (std::vector<std::string>{"sh-9", "environment B"}));
  EXPECT_EQ(names_of(choice.of({.error = 0.1, .memory = 1000})),
            (std::vector<std::string>{"sh-9", "brdf"}));
}

TEST(Candidates, DoNotIgnoreOcclusionWhereThereIsSome) {
  const Candidates candidates = Choice().of({.error = 0.1, .is_occluded = true});
  EXPECT_EQ(names_of(candidates), (std::vector<std::string>{"environment B", "brdf"}));
  const auto unreached = candidates.obstacles.list({});
  ASSERT_EQ(unreached.size(), 1U);
  EXPECT_EQ(unreached[0].family, EstimatorFamily::precomputed);
  EXPECT_THAT(unreached[0].reason, HasSubstr("ignores what is in the way"));
}

std::vector<std::string> reasons_of(const Candidates& candidates) {
  std::vector<std::string> reasons;
  for (const UnreachedFamily& family : candidates.obstacles.list({})) {
    reasons.push_back(std::string(to_string(family.family)) + ": " + family.reason);
  }
  return reasons;
}

TEST(Candidates, SayWhatStopsEachFamilyAndTheLimit) {
  const Candidates candidates = Choice().of({.error = 0.001, .budget_seconds = 0.1});
  EXPECT_TRUE(candidates.possible.empty());
  EXPECT_EQ(
      reasons_of(candidates),
      (std::vector<std::string>{"lobes: brdf needs 4e+06 samples, of 65536 at most",
                                "environment: environment B needs 1e+06 samples, of 65536 at most",
                                "precomputed: the floor of sh-9 is 3 %, above 0.1 %"}));
  EXPECT_THAT(
      reasons_of(Choice().of({.error = 0.05, .budget_seconds = 1e-4})),
      Contains("environment: environment B takes 0.4 ms a shading point, of 0.1 ms allowed"));
  EXPECT_THAT(reasons_of(Choice().of({.error = 0.1, .memory = 1000})),
              Contains("environment: environment B takes 4 MB, of 0.001 MB allowed"));
}

TEST(Candidates, OfWhichABoundIsPredictedHaveTheBenefitOfTheDoubtIfTheyAreTried) {
  Choice choice;
  choice.prediction.estimators = {
      predicted("environment B sobol", ErrorModel::at_most, 100.0, 0.0)};
  choice.costs = costs_of({cost_of("environment B sobol", 0.0, 0.0, 1e-7)});
  const MethodDemand demand = {.error = 0.01};  // 1e6 samples at the most
  EXPECT_TRUE(choice.of(demand).possible.empty());
  MethodDemand tried = demand;
  tried.will_be_tried = true;
  ASSERT_EQ(choice.of(tried).possible.size(), 1U);
  EXPECT_LT(hoped_samples(choice.of(tried).possible[0], tried), 10000U);
}

// A table whose filling is only bounded may be better; what its entries are apart from the points
// is certain.
TEST(Candidates, OfWhichTheBiasIsSmallButTheRestIsABoundAreTried) {
  Choice choice;
  choice.costs = costs_of({cost_of("outgoing table", 0.0, 0.0, 1e-7)});
  choice.prediction.estimators = {predicted("outgoing table", ErrorModel::constant, 0.01, 0.04)};
  MethodDemand demand = {.error = 0.05};
  EXPECT_TRUE(choice.of(demand).possible.empty());
  demand.will_be_tried = true;
  ASSERT_EQ(choice.of(demand).possible.size(), 1U);
  EXPECT_TRUE(is_uncertain(choice.of(demand).possible[0], demand));
  demand.error = 0.03;
  EXPECT_TRUE(choice.of(demand).possible.empty());
}

TEST(Candidates, WithoutAPredictionAreTriedOrNamed) {
  Choice choice;
  choice.costs = costs_of({cost_of("riemann", 0.0, 0.0, 1e-7)});
  choice.prediction.estimators = {{"riemann", std::nullopt, "its error depends on its steps"}};
  MethodDemand demand = {.error = 0.05};
  EXPECT_TRUE(choice.of(demand).possible.empty());
  EXPECT_EQ(reasons_of(choice.of(demand)),
            (std::vector<std::string>{
                "quadrature: riemann is not predicted: its error depends on its steps"}));
  ASSERT_EQ(choice.of(demand).unpredicted.size(), 1U);
  EXPECT_EQ(choice.of(demand).unpredicted[0].estimator, "riemann");
  demand.will_be_tried = true;
  EXPECT_EQ(names_of(choice.of(demand)), (std::vector<std::string>{"riemann"}));
}

TEST(Candidates, WhoseLightIsBlockedAreTriedWhateverIsPredicted) {
  Choice choice;
  choice.costs = costs_of(
      {cost_of("median cut 64", 0.0, 0.0, 1e-7), cost_of("environment B", 0.0, 0.0, 1e-9)});
  choice.prediction.estimators = {predicted("median cut 64", ErrorModel::constant, 0.0, 0.3),
                                  predicted("environment B", ErrorModel::independent, 1e6, 0.0)};
  const MethodDemand demand = {.error = 0.05, .is_occluded = true, .will_be_tried = true};
  EXPECT_EQ(names_of(choice.of(demand)),
            (std::vector<std::string>{"median cut 64", "environment B"}));
  for (const Candidate& candidate : choice.of(demand).possible) {
    EXPECT_TRUE(is_uncertain(candidate, demand));
  }
}

// What is left out of charts has no line that a candidate could be verified by.
TEST(Candidates, AreNoneThatTakeTooLongToBeRun) {
  Choice choice;
  choice.costs = costs_of({cost_of("product table", 0.0, 0.0, 1e-9)});
  choice.prediction.estimators = {predicted("product table", ErrorModel::independent, 0.0, 0.0)};
  const MethodDemand demand = {.error = 0.05, .budget_seconds = 1e6};
  const auto on = [&](Extent extent) {
    return candidates_for(demand, choice.prediction, choice.costs, extent);
  };
  EXPECT_EQ(on({2048, 1024}).possible.size(), 1U);
  EXPECT_TRUE(on({2050, 1025}).possible.empty());
  EXPECT_THAT(reasons_of(on({2050, 1025})).at(0), HasSubstr("takes too long"));
}

TEST(MethodCosts, AreSharedByMaterialsThatTakeTheSame) {
  EXPECT_EQ(material_of_costs(material_of("ggx:0.1")), material_of_costs(material_of("ggx:0.9")));
  EXPECT_NE(material_of_costs(material_of("ggx:0.1")), material_of_costs(material_of("lambert")));
  // Maps are prefiltered by Phong's lobe at a size that its exponent asks for.
  EXPECT_NE(material_of_costs(material_of("phong:5")), material_of_costs(material_of("phong:200")));
}

/// Measured once for the materials that share them and each receiver.
const MethodCosts& costs_on_this_machine(const Material& material, const ReceiverInfo& receiver) {
  static std::map<std::pair<std::string, std::string_view>, MethodCosts> all;
  const std::pair key(material_of_costs(material), receiver.name);
  if (!all.contains(key)) all[key] = measure_method_costs(material, receiver);
  return all.at(key);
}

/// All methods take a microsecond a sample, and nothing beside.
MethodCosts even_costs() {
  std::vector<MethodCost> costs;
  for (const EstimatorInfo& info : estimators()) {
    MethodCost cost = {std::string(info.name), 0.0, 0.0, {1}, {1e-6}};
    if (!info.ignores_budget) cost.samples.push_back(kMostDirections);
    if (!info.ignores_budget) cost.seconds.push_back(1e-6 * kMostDirections);
    costs.push_back(std::move(cost));
  }
  return costs_of(std::move(costs));
}

/// Recommendations on a small map, by costs of this machine.
class Recommended : public testing::Test {
 protected:
  static Recommendation on(const char* map, const char* receiver, const char* material,
                           double error, bool verify = true) {
    const RecommendOptions options = {
        &receiver_by_name(receiver), {material, material_of(material)}, {.error = error}, verify};
    return recommend(make_synthetic_map(map, kMap), options,
                     costs_on_this_machine(options.material.material, *options.receiver));
  }
};

TEST_F(Recommended, IsALookUpUnderAConstantSky) {
  const Recommendation answer = on("constant", "sphere", "lambert", 0.02);
  EXPECT_EQ(estimator_by_name(answer.choice.estimator).family, EstimatorFamily::precomputed);
  EXPECT_LE(answer.choice.measured_error, 0.02);
  ASSERT_TRUE(answer.runner_up);
  EXPECT_NE(answer.runner_up->estimator, answer.choice.estimator);
  EXPECT_THAT(answer.reason, HasSubstr("100 % of the sphere"));
  EXPECT_EQ(answer.warning, "");
}

TEST_F(Recommended, ReachesTheErrorOnAGlossySphereUnderASun) {
  const Recommendation answer = on("sun-sky", "sphere", "ggx:0.4", 0.02);
  EXPECT_LE(answer.choice.measured_error, 1.1 * 0.02);
  EXPECT_GT(answer.choice.measured_error, 0.0);
  ASSERT_TRUE(answer.runner_up);
  const std::uint64_t points = answer.question.shading_points;
  EXPECT_GT(answer.choice.measured_time.point, 0.0);
  EXPECT_LE(answer.choice.measured_time.with_set_up(points),
            answer.runner_up->measured_time.with_set_up(points));
}

TEST_F(Recommended, ReachesItWhereLightIsBlocked) {
  const Recommendation answer = on("sun-sky", "sphere-on-plane", "lambert", 0.05);
  EXPECT_FALSE(estimator_by_name(answer.choice.estimator).ignores_occlusion);
  EXPECT_LE(answer.choice.measured_error, 1.1 * 0.05);
}

TEST_F(Recommended, RunsNothingIfItIsNotToBeVerified) {
  const Recommendation answer = on("gradient", "sphere", "phong:20", 0.05, false);
  EXPECT_TRUE(std::isnan(answer.choice.measured_error));
  EXPECT_TRUE(std::isnan(answer.choice.measured_time.point));
  EXPECT_LE(answer.choice.predicted_error, 0.05);
  EXPECT_EQ(answer.warning, "");
  std::vector<std::string> names;
  for (const UnpredictedMethod& method : answer.unpredicted) names.push_back(method.estimator);
  EXPECT_EQ(names,
            (std::vector<std::string>{"light sets", "riemann", "filtered importance sampling"}));
}

TEST_F(Recommended, SaysThatWhatIsInTheWayIsNotPredicted) {
  const Recommendation answer = on("gradient", "sphere-on-plane", "lambert", 0.05, false);
  EXPECT_THAT(answer.warning, AllOf(HasSubstr("sphere-on-plane"), HasSubstr("not predicted")));
}

// A set-up that takes long against what is shaded is part of what is compared.
TEST_F(Recommended, ComparesTimesWithTheirSetUps) {
  MethodCosts costs = even_costs();
  for (auto* all : {&costs.small, &costs.large}) {
    for (MethodCost& cost : *all)
      cost.set_up_seconds = 1e-3 * static_cast<double>(cost.estimator.size());
  }
  const RecommendOptions options = {&receiver_by_name("sphere"),
                                    {"lambert", material_of("lambert")},
                                    {.error = 0.05, .budget_seconds = 10.0, .shading_points = 100},
                                    false};
  const Recommendation answer = recommend(make_synthetic_map("sun-sky", kMap), options, costs);
  ASSERT_TRUE(answer.runner_up);
  const double times = answer.runner_up->predicted_time.with_set_up(100) /
                       answer.choice.predicted_time.with_set_up(100);
  EXPECT_GE(times, 1.0);
  EXPECT_LT(times, 3.0);  // they take 1 µs, and set-ups of 40 to 200 µs a point
  EXPECT_THAT(answer.reason, HasSubstr(fmt::format("takes {:.2g} times as long", times)));
}

TEST_F(Recommended, IsRefusedWithWhatStopsEachFamily) {
  const RecommendOptions options = {&receiver_by_name("sphere"),
                                    {"ggx:0.3", material_of("ggx:0.3")},
                                    {.error = 1e-6, .budget_seconds = 1e-4}};
  try {
    recommend(make_synthetic_map("sun-sky", kMap), options, even_costs());
    FAIL() << "nothing was thrown";
  } catch (const NoMethodReaches& none) {
    EXPECT_THAT(none.what(), AllOf(HasSubstr("sun-sky"), HasSubstr("environment: environment"),
                                   HasSubstr("precomputed: the floor of")));
    std::vector<std::string> families;
    for (const UnreachedFamily& family : none.refused().unreached) {
      families.emplace_back(to_string(family.family));
    }
    EXPECT_THAT(families, ElementsAre("uniform", "lobes", "environment", "product", "MIS", "RIS",
                                      "point sets", "lights", "quadrature", "precomputed"));
  }
}

// What is in the way of light leaves no prediction: all that is refused was run.
TEST_F(Recommended, IsRefusedAfterASearchWithEveryFamily) {
  MethodCosts costs = even_costs();
  const std::set<std::string> one_of_each = {
      "uniform", "brdf", "environment B",       "product two-level", "mis balance",
      "ris 4",   "sh-9", "environment B sobol", "light sets",        "riemann"};
  for (auto* all : {&costs.small, &costs.large}) {
    std::erase_if(*all,
                  [&](const MethodCost& cost) { return !one_of_each.contains(cost.estimator); });
  }
  const RecommendOptions options = {&receiver_by_name("sphere-on-plane"),
                                    {"lambert", material_of("lambert")},
                                    {.error = 1e-5, .budget_seconds = 8.5e-6}};
  try {
    recommend(make_synthetic_map("sun-sky", kSmall), options, costs);
    FAIL() << "nothing was thrown";
  } catch (const NoMethodReaches& none) {
    EXPECT_EQ(none.refused().unreached.size(), 10U) << none.what();
    EXPECT_THAT(none.what(), AllOf(HasSubstr("quadrature: riemann has an error of"),
                                   HasSubstr("at 8 samples, measured"),
                                   HasSubstr("lights: light sets has an error of"),
                                   HasSubstr("precomputed: sh-9 ignores what is in the way")));
  }
}

TEST_F(Recommended, IsRefusedOnMapsWithoutLightByName) {
  const RecommendOptions options = {
      &receiver_by_name("sphere"), {"lambert", material_of("lambert")}, {.error = 0.05}};
  try {
    recommend({"night", Grid<Rgb>({16, 8})}, options, {});
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("night"), HasSubstr("black")));
  }
}

TEST_F(Recommended, IsRefusedOnTexelsOfAnotherMapping) {
  const RecommendOptions options = {
      &receiver_by_name("sphere"), {"lambert", material_of("lambert")}, {.error = 0.05}};
  const EnvironmentMap cube = make_synthetic_map("constant", {48, 8}, {MappingKind::cube_strip});
  try {
    recommend(cube, options, {});
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--resample"));
  }
}

/// Walls of an even grey, a floor of half of it, and a window of a hundredth of the sphere that is
/// two hundred times as bright.
EnvironmentMap interior() {
  EnvironmentMap map = {"interior", Grid<Rgb>(kSmall)};
  for (int y = 0; y < kSmall.height; ++y) {
    for (int x = 0; x < kSmall.width; ++x) {
      const bool is_window = x >= 35 && x < 48 && y >= 20 && y < 30;
      map.radiance(x, y) = Rgb(is_window ? 40.0F : y > 32 ? 0.1F : 0.2F);
    }
  }
  return map;
}

// Even light needs no sampling, a sun that of the map, and light that comes from everywhere and
// from a window that of both or of points in even order.
TEST_F(Recommended, DependsOnTheLight) {
  const NamedMaterial material = {"ggx:0.2", material_of("ggx:0.2")};
  const RecommendOptions options = {&receiver_by_name("sphere"), material, {.error = 0.05}};
  const auto choice = [&](const EnvironmentMap& map) {
    const Recommendation answer =
        recommend(map, options, costs_on_this_machine(material.material, *options.receiver));
    EXPECT_LE(answer.choice.measured_error, 1.1 * 0.05) << map.name;
    return answer.choice.estimator;
  };
  const std::set<std::string> choices = {choice(make_synthetic_map("constant", kSmall)),
                                         choice(make_synthetic_map("one-texel", kSmall)),
                                         choice(interior())};
  EXPECT_EQ(choices.size(), 3U) << testing::PrintToString(choices);
}

/// Cases that are not as they should be.
std::vector<std::string> worst_text(const std::vector<SurveyCase>& cases) {
  std::vector<std::string> texts;
  for (const SurveyCase& one : worst_of(cases, cases.size())) {
    texts.push_back(
        fmt::format("{} {}: {} at {}, error {}, {} s, best {} in {} s", one.map, one.error,
                    one.choice ? one.choice->estimator : "none",
                    one.choice ? one.choice->samples : 0, one.choice ? one.choice->error : 0.0,
                    one.choice ? one.choice->seconds : 0.0, one.best, one.best_seconds));
  }
  return texts;
}

// What a choice was accepted by says nothing about it any more.
TEST(Survey, JudgesByOtherRandomNumbersThanThoseOfTheChoice) {
  const SurveyOptions options = {.receiver = &receiver_by_name("sphere"),
                                 .errors = {0.05},
                                 .quality = accuracy_quality_by_name("draft")};
  const auto cases =
      survey(make_synthetic_map("gradient", {32, 16}), {"lambert", material_of("lambert")}, options,
             costs_of({cost_of("environment B", 0.0, 0.0, 1e-7)}));
  ASSERT_EQ(cases.size(), 1U);
  ASSERT_TRUE(cases[0].choice);
  EXPECT_EQ(cases[0].choice->estimator, "environment B");
  EXPECT_NE(cases[0].choice->error, cases[0].choice->verified_error);
  EXPECT_NEAR(cases[0].choice->error, 0.05, 0.005);  // a tenth is what a survey allows
  EXPECT_GT(cases[0].choice->seconds, 0.0);
}

TEST(Survey, ReachesItsGoalsUnderASun) {
  const NamedMaterial material = {"phong:20", material_of("phong:20")};
  const SurveyOptions options = {.receiver = &receiver_by_name("sphere"),
                                 .errors = {0.1, 0.03, 1e-6},
                                 .quality = accuracy_quality_by_name("draft")};
  const std::vector<SurveyCase> cases =
      survey(make_synthetic_map("sun-sky", kMap), material, options,
             costs_on_this_machine(material.material, *options.receiver));
  ASSERT_EQ(cases.size(), 3U);
  const SurveyShares shares = shares_of(cases);
  EXPECT_TRUE(shares.reaches_goals())
      << shares.errors_kept << " of errors, " << shares.times_kept
      << " of times; worst: " << testing::PrintToString(worst_text(cases));
  EXPECT_TRUE(cases[2].is_rightly_refused());
}

}  // namespace
}  // namespace lightproof
