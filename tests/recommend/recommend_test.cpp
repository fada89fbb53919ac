// Which methods are candidates, and what is recommended of them.
#include "lightproof/recommend/recommend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/recommend/survey.h"

namespace lightproof {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr Extent kMap = {256, 128};

MethodCost cost_of(const char* estimator, double set_up, double bytes, double seconds) {
  return {estimator, set_up, bytes, {1, 100}, {seconds, 100.0 * seconds}};
}

MethodCosts costs_of(std::vector<MethodCost> costs) { return {costs, costs}; }

EstimatorPrediction predicted(const char* estimator, ErrorLaw law, double variance, double bias) {
  return {estimator_by_name(estimator).name, PredictedError{law, variance, bias}, ""};
}

std::vector<std::string> names_of(const Candidates& candidates) {
  std::vector<std::string> names;
  for (const Candidate& candidate : candidates.reaching) names.emplace_back(candidate.info->name);
  return names;
}

/// An unbiased method of 1 us a sample, a slower and a biased one.
struct Choice {
  MethodCosts costs =
      costs_of({cost_of("environment B", 0.1, 4e6, 1e-6), cost_of("brdf", 0.0, 0.0, 1e-6),
                cost_of("sh-9", 1.0, 200.0, 3e-8)});
  Prediction prediction = {1.0,
                           {predicted("environment B", ErrorLaw::independent, 1.0, 0.0),
                            predicted("brdf", ErrorLaw::independent, 4.0, 0.0),
                            predicted("sh-9", ErrorLaw::constant, 0.0, 0.03)}};

  Candidates of(const MethodDemand& demand) const {
    return candidates_for(demand, prediction, costs, kMap);
  }
};

TEST(SamplesFor, AreTheVarianceOverWhatTheBiasLeaves) {
  const EstimatorInfo& one = estimator_by_name("environment B");
  EXPECT_EQ(samples_for(one, {ErrorLaw::independent, 1.0, 0.0}, 0.1), 100U);
  EXPECT_EQ(samples_for(one, {ErrorLaw::independent, 1.001, 0.0}, 0.1), 101U);
  EXPECT_EQ(samples_for(one, {ErrorLaw::independent, 1.0, 0.06}, 0.1), 157U);  // 1 / .0064
  EXPECT_EQ(samples_for(one, {ErrorLaw::independent, 1.0, 0.1}, 0.1), std::nullopt);
  EXPECT_EQ(samples_for(one, {ErrorLaw::independent, 0.0, 0.0}, 0.1), 1U);
  EXPECT_EQ(samples_for(estimator_by_name("mis balance"), {ErrorLaw::independent, 1.001, 0.0}, 0.1),
            102U);
  EXPECT_EQ(samples_for(one, {ErrorLaw::constant, 0.0, 0.09}, 0.1), 1U);
  EXPECT_EQ(samples_for(one, {ErrorLaw::constant, 0.0, 0.11}, 0.1), std::nullopt);
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
  ASSERT_EQ(candidates.unreached.size(), 1U);
  EXPECT_EQ(candidates.unreached[0].family, "precomputed");
  EXPECT_THAT(candidates.unreached[0].reason, HasSubstr("ignores what is in the way"));
}

TEST(Candidates, SayWhatStopsEachFamily) {
  const Candidates candidates = Choice().of({.error = 0.001, .budget_seconds = 0.1});
  EXPECT_TRUE(candidates.reaching.empty());
  ASSERT_EQ(candidates.unreached.size(), 3U);
  EXPECT_EQ(candidates.unreached[0].reason, "brdf needs 4e+06 samples");
  EXPECT_EQ(candidates.unreached[1].reason, "environment B needs 1e+06 samples");
  EXPECT_EQ(candidates.unreached[2].reason, "the floor of sh-9 is 3 %");
}

TEST(Candidates, OfWhichABoundIsPredictedHaveTheBenefitOfTheDoubtIfTheyAreTried) {
  Choice choice;
  choice.prediction.estimators = {predicted("environment B sobol", ErrorLaw::at_most, 100.0, 0.0)};
  choice.costs = costs_of({cost_of("environment B sobol", 0.0, 0.0, 1e-7)});
  const MethodDemand demand = {.error = 0.01};  // 1e6 samples at the most
  EXPECT_TRUE(choice.of(demand).reaching.empty());
  MethodDemand tried = demand;
  tried.will_be_tried = true;
  ASSERT_EQ(choice.of(tried).reaching.size(), 1U);
  EXPECT_LT(fewest_samples(choice.of(tried).reaching[0], tried), 10000U);
}

/// Measured once for each kind of material and each receiver.
const MethodCosts& costs_on_this_machine(const Material& material, const ReceiverInfo& receiver) {
  static std::map<std::pair<std::size_t, std::string_view>, MethodCosts> all;
  const std::pair key(material.index(), receiver.name);
  if (!all.contains(key)) all[key] = measure_method_costs(material, receiver);
  return all.at(key);
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
  EXPECT_LE(answer.choice.milliseconds, answer.runner_up->milliseconds);
}

TEST_F(Recommended, ReachesItWhereLightIsBlocked) {
  const Recommendation answer = on("sun-sky", "sphere-on-plane", "lambert", 0.05);
  EXPECT_FALSE(estimator_by_name(answer.choice.estimator).ignores_occlusion);
  EXPECT_LE(answer.choice.measured_error, 1.1 * 0.05);
}

TEST_F(Recommended, RunsNothingIfItIsNotToBeVerified) {
  const Recommendation answer = on("gradient", "sphere", "phong:20", 0.05, false);
  EXPECT_TRUE(std::isnan(answer.choice.measured_error));
  EXPECT_LE(answer.choice.predicted_error, 0.05);
}

TEST_F(Recommended, IsRefusedWithWhatStopsEachFamily) {
  try {
    on("sun-sky", "sphere", "ggx:0.3", 1e-6);
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("sun-sky"), HasSubstr("environment: environment"),
                                    HasSubstr("precomputed: the floor of")));
  }
}

TEST(Survey, HoldsChoicesAgainstEveryMethod) {
  const NamedMaterial material = {"phong:20", material_of("phong:20")};
  const SurveyOptions options = {.receiver = &receiver_by_name("sphere"),
                                 .errors = {0.1, 1e-6},
                                 .quality = accuracy_quality_by_name("draft")};
  const auto cases = survey(make_synthetic_map("sun-sky", kMap), material, options,
                            costs_on_this_machine(material.material, *options.receiver));
  ASSERT_EQ(cases.size(), 2U);
  ASSERT_TRUE(cases[0].choice);
  EXPECT_TRUE(cases[0].error_is_kept())
      << cases[0].choice->estimator << ": " << cases[0].choice->measured_error;
  EXPECT_GT(cases[0].choice_seconds, 0.0);
  EXPECT_FALSE(cases[0].best.empty());
  EXPECT_FALSE(cases[1].choice);
  EXPECT_TRUE(cases[1].best.empty());
  EXPECT_TRUE(cases[1].error_is_kept() && cases[1].time_is_kept());
}

TEST(SurveyCase, JudgesErrorAndTime) {
  SurveyCase one{"map", "lambert", 0.1, RecommendedMethod{}, 1.4, "brdf", 1.0};
  one.choice->measured_error = 0.109;
  EXPECT_TRUE(one.error_is_kept() && one.time_is_kept());
  one.choice->measured_error = 0.111;
  EXPECT_FALSE(one.error_is_kept());
  one.choice_seconds = 1.6;
  EXPECT_FALSE(one.time_is_kept());
  one.choice.reset();
  EXPECT_FALSE(one.error_is_kept() || one.time_is_kept());
  one.best.clear();
  EXPECT_TRUE(one.error_is_kept() && one.time_is_kept());
}

}  // namespace
}  // namespace lightproof
