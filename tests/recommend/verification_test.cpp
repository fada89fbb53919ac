// What becomes of candidates when they are run: by estimators whose errors and times are known.
#include "lightproof/recommend/verification.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "lightproof/estimators/registry.h"

namespace lightproof {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// What a run finds of an estimator: its error by the number of samples, and its time of a sample.
struct Behaviour {
  std::function<double(std::uint64_t)> error;
  double seconds = 1e-6;
};

/// Falls with the root of the number of samples.
Behaviour falling(double of_one_sample, double seconds = 1e-6) {
  return {[=](std::uint64_t n) { return of_one_sample / std::sqrt(static_cast<double>(n)); },
          seconds};
}

/// Falls with the number of samples.
Behaviour falling_steeply(double of_one_sample) {
  return {[=](std::uint64_t n) { return of_one_sample / static_cast<double>(n); }};
}

Behaviour constant(double error, double seconds = 1e-6) {
  return {[=](std::uint64_t) { return error; }, seconds};
}

/// Runs of which everything is known, and which remember what they were asked.
struct KnownRuns {
  std::map<std::string, Behaviour, std::less<>> estimators;
  std::vector<std::string> purposes;
  std::map<std::string, std::vector<std::uint64_t>, std::less<>> asked;

  RunEstimators run() {
    return [this](const SamplesOf& samples, const RunKind& kind) {
      purposes.push_back(kind.purpose);
      MeasuredLines lines;
      for (const auto& [name, numbers] : samples) {
        AccuracyLine line;
        line.estimator = name;
        const Behaviour& known = estimators.find(name)->second;
        for (const std::uint64_t n : numbers) {
          asked[line.estimator].push_back(n);
          const double error = known.error(n);
          line.points.push_back({n, known.seconds * static_cast<double>(n), error, 0.01 * error});
        }
        lines.emplace(line.estimator, line);
      }
      return lines;
    };
  }
};

Candidate candidate_of(const char* name, const PredictedError& error, std::uint64_t samples,
                       double seconds = 1e-6) {
  const EstimatorInfo& info = estimator_by_name(name);
  MethodCost cost = {name, 0.0, 0.0, {1}, {seconds}};
  if (!info.ignores_budget) cost = {name, 0.0, 0.0, {1, 65536}, {seconds, 65536.0 * seconds}};
  return {&info, error, cost, samples};
}

constexpr PredictedError kIndependent = {ErrorModel::independent, 1.0, 0.0};
constexpr PredictedError kAtMost = {ErrorModel::at_most, 1.0, 0.0};

std::vector<std::string> names_of(const std::vector<Candidate>& candidates) {
  std::vector<std::string> names;
  for (const Candidate& candidate : candidates) names.emplace_back(candidate.info->name);
  return names;
}

std::vector<std::string> names_of(const std::vector<Verified>& verified) {
  std::vector<std::string> names;
  for (const Verified& one : verified) names.emplace_back(one.candidate.info->name);
  return names;
}

const MethodDemand kDemand = {.error = 0.1, .budget_seconds = 1.0, .will_be_tried = true};

TEST(Search, FindsTheSamplesOfWhatIsOnlyBounded) {
  KnownRuns known = {{{"brdf sobol", falling(0.55)}}, {}, {}};
  const Search search =
      search_samples(known.run(), kDemand, {candidate_of("brdf sobol", kAtMost, 100)});
  ASSERT_EQ(names_of(search.found), std::vector<std::string>{"brdf sobol"});
  EXPECT_EQ(search.found[0].samples, 31U);  // 5.5 squared is 30.25
}

// The prediction is a guess where something is in the way: four hundred times as many samples may
// be needed.
TEST(Search, GoesOnToTheMostSamplesWhereLightIsBlocked) {
  MethodDemand occluded = kDemand;
  occluded.is_occluded = true;
  KnownRuns known = {{{"environment B", falling(20.0)}}, {}, {}};
  const Search search =
      search_samples(known.run(), occluded, {candidate_of("environment B", kIndependent, 100)});
  ASSERT_EQ(names_of(search.found), std::vector<std::string>{"environment B"});
  EXPECT_EQ(search.found[0].samples, 40000U);
}

TEST(Search, KeepsToTheBudgetAndSaysWhatWasMeasured) {
  MethodDemand occluded = kDemand;
  occluded.is_occluded = true;
  occluded.budget_seconds = 1000.5e-6;
  KnownRuns known = {{{"environment B", falling(20.0)}}, {}, {}};
  const Search search =
      search_samples(known.run(), occluded, {candidate_of("environment B", kIndependent, 100)});
  EXPECT_THAT(names_of(search.found), IsEmpty());
  ASSERT_EQ(search.failed.size(), 1U);
  EXPECT_EQ(known.asked["environment B"].back(), 1000U);
  EXPECT_EQ(search.failed[0].second.reason,
            "environment B has an error of 63 % at 1000 samples, measured");
}

TEST(Search, EndsWhereOthersTakeMuchLessTime) {
  KnownRuns known = {{{"brdf sobol", falling(0.5)},
                      {"brdf R2", falling(0.4)},
                      {"environment B sobol", falling(20.0)}},
                     {},
                     {}};
  const Search search = search_samples(
      known.run(), kDemand,
      {candidate_of("brdf sobol", kAtMost, 100), candidate_of("brdf R2", kAtMost, 100),
       candidate_of("environment B sobol", kAtMost, 50000)});
  EXPECT_EQ(names_of(search.found), (std::vector<std::string>{"brdf R2", "brdf sobol"}));
  EXPECT_THAT(search.failed, IsEmpty());
  EXPECT_EQ(names_of(search.too_slow), std::vector<std::string>{"environment B sobol"});
}

TEST(Search, TriesWhatIsNotPredicted) {
  Candidate riemann = candidate_of("riemann", {}, 0);
  riemann.error.reset();
  KnownRuns known = {{{"riemann", falling(0.45)}}, {}, {}};
  const Search search = search_samples(known.run(), kDemand, {riemann});
  ASSERT_EQ(names_of(search.found), std::vector<std::string>{"riemann"});
  EXPECT_EQ(search.found[0].samples, 21U);
}

// No sun was seen: nothing is known of the error.
TEST(Search, DoesNotBelieveAnErrorThatRareSamplesCarry) {
  const RunEstimators run = [](const SamplesOf& samples, const RunKind&) {
    MeasuredLines lines;
    for (const auto& [name, numbers] : samples) {
      AccuracyLine line;
      line.estimator = name;
      for (const std::uint64_t n : numbers) line.points.push_back({n, 1e-6, 0.001, 10.0});
      lines.emplace(line.estimator, line);
    }
    return lines;
  };
  const Search search = search_samples(run, kDemand, {candidate_of("brdf sobol", kAtMost, 100)});
  EXPECT_THAT(names_of(search.found), IsEmpty());
  EXPECT_THAT(search.failed.at(0).second.reason, HasSubstr("too rare to be seen"));
}

TEST(Verification, GivesMoreSamplesToWhatMissesTheError) {
  KnownRuns known = {{{"environment B", falling(1.5)}}, {}, {}};
  const Verification made =
      verify(known.run(), kDemand, {candidate_of("environment B", kIndependent, 100)});
  ASSERT_EQ(names_of(made.reaching), std::vector<std::string>{"environment B"});
  EXPECT_EQ(made.reaching[0].candidate.samples, 225U);
  EXPECT_THAT(known.asked["environment B"], ElementsAre(100U, 225U));
  // Other random numbers every time.
  EXPECT_EQ(std::set<std::string>(known.purposes.begin(), known.purposes.end()).size(), 2U);
}

// A net of points whose error falls faster than the one that was looked for: 150 samples at 1/n.
TEST(Verification, TriesFewerSamplesOfWhatIsOnlyBounded) {
  KnownRuns known = {{{"brdf sobol", falling_steeply(15.0)}}, {}, {}};
  const Verification made =
      verify(known.run(), kDemand, {candidate_of("brdf sobol", kAtMost, 600)});
  ASSERT_EQ(names_of(made.reaching), std::vector<std::string>{"brdf sobol"});
  const std::uint64_t samples = made.reaching[0].candidate.samples;
  EXPECT_GE(samples, 150U);
  EXPECT_LE(samples, 190U);
  EXPECT_LE(known.asked["brdf sobol"].size(), 4U);
}

TEST(Verification, TakesAPowerOfTwoThatLiesNear) {
  KnownRuns known = {{{"brdf sobol", falling_steeply(12.0)}}, {}, {}};
  const Verification made =
      verify(known.run(), kDemand, {candidate_of("brdf sobol", kAtMost, 240)});
  ASSERT_EQ(names_of(made.reaching), std::vector<std::string>{"brdf sobol"});
  EXPECT_EQ(made.reaching[0].candidate.samples, 128U);
}

TEST(Verification, LeavesTheSamplesOfWhatIsPredicted) {
  KnownRuns known = {{{"environment B", falling(0.5)}}, {}, {}};
  const Verification made =
      verify(known.run(), kDemand, {candidate_of("environment B", kIndependent, 100)});
  EXPECT_THAT(known.asked["environment B"], ElementsAre(100U));
}

TEST(Verification, KeepsToTheBudgetWhenItGivesMoreSamples) {
  MethodDemand demand = kDemand;
  demand.budget_seconds = 200e-6;
  KnownRuns known = {{{"environment B", falling(1.5)}}, {}, {}};
  const Verification made =
      verify(known.run(), demand, {candidate_of("environment B", kIndependent, 100)});
  EXPECT_THAT(names_of(made.reaching), IsEmpty());
  ASSERT_EQ(made.failed.size(), 1U);
  EXPECT_THAT(made.failed[0].second.reason, HasSubstr("of 0.2 ms allowed"));
}

TEST(Verification, GivesUpWhatMoreSamplesDoNotHelp) {
  KnownRuns known = {{{"riemann", constant(0.2)}}, {}, {}};
  const Verification made =
      verify(known.run(), kDemand, {candidate_of("riemann", kIndependent, 100)});
  EXPECT_THAT(names_of(made.reaching), IsEmpty());
  EXPECT_THAT(known.asked["riemann"], ElementsAre(100U, 400U, 1600U, 6400U));
}

TEST(Verification, DropsALookUpThatMissesTheErrorAndGoesOn) {
  KnownRuns known = {
      {{"median cut 64", constant(0.3)}, {"sh-9", constant(0.2)}, {"environment B", falling(1.0)}},
      {},
      {}};
  const Verification made =
      verify(known.run(), kDemand,
             {candidate_of("median cut 64", {ErrorModel::constant, 0.0, 0.05}, 1, 1e-8),
              candidate_of("sh-9", {ErrorModel::constant, 0.0, 0.05}, 1, 1e-8),
              candidate_of("environment B", kIndependent, 100)});
  EXPECT_EQ(names_of(made.reaching), std::vector<std::string>{"environment B"});
  ASSERT_EQ(made.failed.size(), 2U);
  EXPECT_EQ(made.failed[0].second.reason, "median cut 64 has an error of 30 %, measured");
  EXPECT_THAT(known.asked["median cut 64"], ElementsAre(1U));
}

TEST(Verification, RanksByMeasuredTime) {
  KnownRuns known = {{{"environment B", falling(1.0, 3e-6)}, {"brdf", falling(1.0, 1e-6)}}, {}, {}};
  const Verification made = verify(known.run(), kDemand,
                                   {candidate_of("environment B", kIndependent, 100, 1e-6),
                                    candidate_of("brdf", kIndependent, 100, 2e-6)});
  EXPECT_EQ(names_of(made.reaching), (std::vector<std::string>{"brdf", "environment B"}));
}

// The first ones turn out to take longer than what comes next was expected to.
TEST(Verification, GoesOnWhileOthersMayTakeLessTime) {
  KnownRuns known;
  std::vector<Candidate> candidates;
  for (const char* name : {"environment B", "environment A", "environment C", "cosine"}) {
    known.estimators[name] = falling(1.0, 9e-6);
    candidates.push_back(candidate_of(name, kIndependent, 100, 1e-6));
  }
  known.estimators["brdf"] = falling(1.0, 2e-6);
  candidates.push_back(candidate_of("brdf", kIndependent, 100, 2e-6));
  known.estimators["uniform"] = falling(1.0, 2e-6);
  candidates.push_back(candidate_of("uniform", kIndependent, 100, 2e-5));
  KnownRuns far = known;
  EXPECT_EQ(names_of(verify(known.run(), kDemand, candidates).reaching).front(), "brdf");
  candidates.erase(candidates.begin() + 4);
  const Verification made = verify(far.run(), kDemand, candidates);
  EXPECT_EQ(made.reaching.size(), 4U);
  EXPECT_EQ(names_of(made.too_slow), std::vector<std::string>{"uniform"});
}

TEST(CredibleError, IsTheExactOneIfTheMeasuredOneAgrees) {
  EXPECT_EQ(credible_error({1, 0.0, 0.11, 0.005, 0.1}), 0.1);
  EXPECT_EQ(credible_error({1, 0.0, 0.13, 0.005, 0.1}), 0.13);
  EXPECT_EQ(credible_error({1, 0.0, 0.13, 0.005}), 0.13);
  EXPECT_TRUE(std::isinf(credible_error({1, 0.0, 0.01, 0.1})));
}

}  // namespace
}  // namespace lightproof
