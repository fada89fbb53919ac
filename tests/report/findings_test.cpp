#include "lightproof/report/findings.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "fixture.h"

namespace lightproof {
namespace {

StudyResult with_tests(std::vector<TestRecord> tests) {
  StudyResult study;
  study.gate = {1e-6, 1000, 1, std::move(tests)};
  return study;
}

ConvergenceRecord estimator(double slope, double ratio) {
  ConvergenceRecord r;
  r.map = "city";
  r.receiver = "sphere";
  r.material = "Lambert";
  r.estimator = "uniform";
  r.slope = slope;
  r.slope_error = 0.01;
  r.predicted_variance = 2.0;
  r.measured_variance = 2.0 * ratio;
  r.variance_ratio_error = 0.01;
  return r;
}

TEST(Headline, CountsTheTestsOfCorrectSamplers) {
  TestRecord other = testing::accepted_test("linear_scan_published", "city");
  other.outcome = Outcome::reject;
  other.known_defect = true;
  std::vector<TestRecord> tests = {other, testing::accepted_test("binary_search", "city"),
                                   testing::accepted_test("binary_search", "night")};
  EXPECT_EQ(headline(with_tests(tests)),
            "On two maps, binary_search draws the right distribution: 0 of 2 tests rejected at a "
            "family-wise error of 1e-6");
  tests.push_back(testing::accepted_test("alias", "city"));
  EXPECT_EQ(
      headline(with_tests(tests)),
      "On two maps, all 2 correct samplers draw the right distribution: 0 of 3 tests rejected "
      "at a family-wise error of 1e-6");
  EXPECT_EQ(headline(with_tests({other})),
            "On one map, linear_scan_published does not draw the right distribution: 1 of 1 test "
            "rejected at a family-wise error of 1e-6");
}

TEST(Headline, NamesTheGuiltyAmongSeveral) {
  std::vector<TestRecord> tests;
  for (const char* name : {"binary_search", "alias", "eytzinger"}) {
    tests.push_back(testing::accepted_test(name, "city"));
  }
  tests[1].outcome = Outcome::reject;
  EXPECT_EQ(headline(with_tests(tests)),
            "On one map, alias alone does not draw the right distribution: 1 of 3 tests rejected "
            "at a family-wise error of 1e-6");
  tests[2].outcome = Outcome::reject;
  EXPECT_EQ(headline(with_tests(tests)),
            "On one map, 2 of 3 samplers do not draw the right distribution: 2 of 3 tests rejected "
            "at a family-wise error of 1e-6");
}

TEST(Headline, AdmitsRejection) {
  TestRecord bad = testing::accepted_test("binary_search", "city");
  bad.outcome = Outcome::reject;
  EXPECT_EQ(headline(with_tests({bad, testing::accepted_test("binary_search", "city")})),
            "On one map, binary_search does not draw the right distribution: 1 of 2 tests rejected "
            "at a family-wise error of 1e-6");
}

TEST(Headline, LeavesTheInconclusiveOpen) {
  TestRecord open = testing::accepted_test("binary_search", "city");
  open.outcome = Outcome::inconclusive;
  EXPECT_EQ(headline(with_tests({open, testing::accepted_test("binary_search", "city")})),
            "On one map, the verdict on binary_search is open: 1 of 2 tests inconclusive, none "
            "rejected");
  EXPECT_EQ(headline({}), "No test was run");
}

TEST(SamplerFindings, NameTheWorstTestAndKnownDefects) {
  TestRecord mild = testing::accepted_test("linear_scan_published", "city");
  mild.outcome = Outcome::reject;
  mild.log10_p = -8.0;
  mild.known_defect = true;
  TestRecord grave = mild;
  grave.test = TestId::rows;
  grave.log10_p = -80.0;
  grave.detail = "row 0 is never drawn";
  const auto findings =
      sampler_findings(with_tests({testing::accepted_test("alias", "city"), mild, grave}).gate);
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[0].outcome, Outcome::accept);
  EXPECT_EQ(findings[0].sentence, "alias: 0 of 1 test rejected");
  EXPECT_EQ(findings[1].outcome, Outcome::reject);
  EXPECT_FALSE(findings[0].is_demonstration);
  EXPECT_TRUE(findings[1].is_demonstration);
  EXPECT_EQ(findings[1].sentence,
            "linear_scan_published: 2 of 2 tests rejected (kept as published, with its known "
            "defects); for example reference/rows of linear_scan_published B on city (row 0 is "
            "never drawn)");
}

TEST(SamplerFindings, GiveAcceptedSamplersOfDirectionsOneLine) {
  const std::string directions(kDirections);
  TestRecord wrong = testing::accepted_test("phong", directions);
  wrong.outcome = Outcome::reject;
  const auto findings =
      sampler_findings(with_tests({testing::accepted_test("cosine", directions),
                                   testing::accepted_test("alias", "city"),
                                   testing::accepted_test("ggx", directions),
                                   testing::accepted_test("ggx", directions), wrong})
                           .gate);
  ASSERT_EQ(findings.size(), 3U);
  EXPECT_EQ(findings[0].sentence, "alias: 0 of 1 test rejected");
  EXPECT_EQ(findings[1].outcome, Outcome::reject) << findings[1].sentence;
  EXPECT_EQ(findings[2].sentence,
            "2 samplers of directions (warps and materials): 0 of 3 tests rejected");
  EXPECT_EQ(findings[2].outcome, Outcome::accept);
}

TEST(ConvergenceFinding, GivesTheRangeWhenAllAgree) {
  EXPECT_EQ(convergence_finding({estimator(-0.51, 1.0), estimator(-0.48, 1.0)}),
            "All 2 estimators fall with slope \u22120.5 as predicted: fitted slopes from "
            "\u22120.510 to \u22120.480, each within 3 of its standard errors (0.010 to 0.010)");
}

TEST(ConvergenceFinding, NamesTheFarthest) {
  EXPECT_EQ(convergence_finding({estimator(-0.51, 1.0), estimator(-0.4, 1.0)}),
            "1 of 2 estimators fall with slope \u22120.5 within 3 standard errors (normal errors "
            "would leave 0.0054 outside); the farthest is uniform on city, sphere, Lambert with "
            "slope \u22120.400 \u00b1 0.010");
}

TEST(ConvergenceFinding, SetsEstimatorsWithoutASlopeApart) {
  EXPECT_EQ(convergence_finding({estimator(-0.5, 1.0), estimator(std::nan(""), 1.0)}),
            "The one estimator falls with slope \u22120.5 as predicted: fitted slopes from "
            "\u22120.500 to \u22120.500, each within 3 of its standard errors (0.010 to 0.010); 1 "
            "other could not be fitted");
  EXPECT_EQ(convergence_finding({}), "No slope could be fitted");
}

TEST(PredictionFinding, CountsPointsAndNamesTheFarthest) {
  ConvergenceRecord r = estimator(-0.5, 1.0);
  r.points = {{16, 1.0, 0.1, 1.05}, {64, 0.5, 0.05, 0.75}};
  const std::string text =
      "1 of 2 measured points lie within 3 standard errors of the predicted error (normal errors "
      "would leave 0.0054 outside); the farthest is 5 standard errors away (uniform on city, "
      "sphere, Lambert).";
  EXPECT_EQ(prediction_finding({r}), text);
  r.points.push_back({4, 1.0, 2000.0, 300.0});
  EXPECT_EQ(prediction_finding({r}),
            text +
                " Left out of this count: 1 point whose standard error is unknown or more than "
                "a third of the prediction.");
}

TEST(Estimators, WithoutAStandardErrorAreNotJudged) {
  ConvergenceRecord r = estimator(-0.5, 1.00001);
  EXPECT_TRUE(has_ratio(r));
  EXPECT_TRUE(has_slope(r));
  r.variance_ratio_error = 0.0;
  r.slope_error = std::nan("");
  EXPECT_FALSE(has_ratio(r));
  EXPECT_FALSE(has_slope(r));
  r.variance_ratio_error = 0.01;
  r.measured_variance = 0.0;
  r.predicted_variance = 8e-11;  // what quadrature leaves of an exact zero
  EXPECT_TRUE(is_all_but_exact(r));
  EXPECT_FALSE(has_ratio(r));
}

TEST(VarianceFinding, AgreesOrNamesTheFarthest) {
  EXPECT_EQ(variance_finding({estimator(-0.5, 0.99), estimator(-0.5, 1.02)}),
            "All 2 ratios of measured to predicted variance within 3 standard errors of 1: from "
            "0.990 to 1.02");
  EXPECT_EQ(variance_finding({estimator(-0.5, 0.99), estimator(-0.5, 1.5)}),
            "1 of 2 ratios of measured to predicted variance within 3 standard errors of 1 (normal "
            "errors would leave 0.0054 outside); the farthest is uniform on city, sphere, Lambert "
            "with 1.500 \u00b1 0.010");
  // A ratio that hardly tests anything is not counted.
  ConvergenceRecord vague = estimator(-0.5, 3.0);
  vague.variance_ratio_error = 1.0;
  EXPECT_EQ(variance_finding({estimator(-0.5, 0.99), vague}),
            "The one ratio of measured to predicted variance within 3 standard errors of 1: from "
            "0.990 to 0.990; 1 not counted, with a standard error above a third");
  EXPECT_EQ(variance_finding({}), "No variance was both measured and predicted");
}

StudyResult speeds(double slow_small, double slow_large) {
  StudyResult study;
  study.throughput = {
      {"linear_scan", "sun", {512, 256}, 5000.0, 1.0, 1.0, 0.0, 0.0},
      {"binary_search", "sun", {512, 256}, 10.0, 9.0, 11.0, 0.0, 0.0},
      {"binary_search", "sun", {1024, 512}, 10.0, 9.0, 11.0, 0.0, 0.0},
      {"linear_scan_published", "sun", {512, 256}, slow_small, 1.0, 1.0, 0.0, 0.0},
      {"linear_scan_published", "sun", {1024, 512}, slow_large, 1.0, 1.0, 0.0, 0.0}};
  return study;
}

TEST(ThroughputFinding, ComparesTheFastestOnTheLargestMapWithThePublishedScan) {
  EXPECT_EQ(throughput_finding(speeds(130.0, 400.0)),
            "binary_search is 13 to 40 times as fast as linear_scan_published, from 512\u00d7256 "
            "to 1024\u00d7512, and the gap grows with the map");
}

TEST(GrowthFinding, GivesTheLeastAndTheLargestExponent) {
  const std::vector<StepTime> steps = {{{64, 32}, 0.7}, {{128, 64}, 0.5}, {{256, 128}, 2.25}};
  const GrowthFit a = {"a", "S + T", 1.02, 0.1, steps};
  const GrowthFit b = {"b", "log2 S + log2 T", 0.5, 0.1, steps};
  const GrowthFit c = {"c", "1", 0.1, 0.1, steps};
  EXPECT_EQ(growth_finding({a}), "The time per sample grows like S + T to the power of 1.0 (a)");
  EXPECT_EQ(growth_finding({b, a, c}),
            "The time per sample grows like S + T to the power of 0.10 (c) to 1.0 (a)");
  EXPECT_EQ(step_range(a).fastest.extent, (Extent{128, 64}));
  EXPECT_EQ(step_range(a).slowest.extent, (Extent{256, 128}));
}

TEST(CachesFinding, NamesTheFirstTableAndTheLastToOutgrowACache) {
  GrowthFit small;
  small.sampler = "small";
  small.leaves_l2 = {1024, 512};
  GrowthFit large = small;
  large.sampler = "large";
  large.leaves_l2 = {256, 128};
  large.leaves_l3 = {2048, 1024};
  const CacheSizes caches = {1048576.0, 50331648.0};
  EXPECT_EQ(caches_finding({small, large}, caches),
            "Tables outgrow L2 (1\u00a0MiB) at 256\u00d7128 (large) to "
            "1024\u00d7512 (small), L3 (48\u00a0MiB) at 2048\u00d71024 (large). ");
  EXPECT_EQ(caches_finding({small}, {1048576.0, {}}),
            "Tables outgrow L2 (1\u00a0MiB) at 1024\u00d7512 (small). ");
  EXPECT_EQ(caches_finding({small, small}, caches),
            "Tables outgrow L2 (1\u00a0MiB) at 1024\u00d7512. ");
  EXPECT_EQ(caches_finding({GrowthFit{}}, caches), "All tables fit into the caches. ");
  EXPECT_EQ(caches_finding({small}, {}), "The sizes of the caches are not known. ");
}

TEST(BreakpointsFinding, NamesTheSamplersThatHaveOne) {
  GrowthFit straight;
  GrowthFit bent;
  bent.sampler = "bent";
  bent.segmented = {0.0, {{{512, 256}, 0.5}, {{2048, 1024}, 0.1}}, 0.001};
  EXPECT_EQ(
      breakpoints_finding({straight, bent}),
      "The time of a step has measured breakpoints: bent at 512\u00d7256 and 2048\u00d71024.");
  EXPECT_EQ(breakpoints_finding({straight}), "The time of a step has no measured breakpoint.");
}

TEST(BuildFinding, GivesTheExponentsAndTheSlowestOnTheLargestMap) {
  StudyResult study = speeds(130.0, 400.0);
  study.throughput[0].build_ms = 99.0;  // on a small map
  study.throughput[2].build_ms = 3.0;
  study.throughput[4].build_ms = 5100.0;
  EXPECT_EQ(build_finding(study),
            "Of the builds linear_scan_published takes longest at 1024\u00d7512, 5.10 s");
  GrowthFit fit;
  fit.sampler = "linear_scan";
  fit.build_exponent = {1.1, 0.1};
  study.growth = {fit};
  EXPECT_EQ(build_finding(study),
            "The time to build grows like S \u00d7 T to the power of 1.1 (linear_scan); "
            "linear_scan_published takes longest at 1024\u00d7512, 5.10 s");
  EXPECT_EQ(build_finding({}), "");
}

TEST(SavingFinding, ComparesTheBestWithTheWorstByPrediction) {
  ConvergenceRecord good = estimator(-0.5, 1.0);
  ConvergenceRecord bad = estimator(-0.5, 1.0);
  good.estimator = "good";
  bad.estimator = "bad";
  good.predicted_variance = 0.5;
  bad.predicted_variance = 20.0;
  EXPECT_EQ(saving_finding({&bad, &good}), "good needs 40 times fewer samples than bad");
  bad.predicted_variance = 18157.5;
  EXPECT_EQ(saving_finding({&bad, &good}), "good needs 36,000 times fewer samples than bad");
  EXPECT_EQ(saving_finding({&good}), "no estimator is ahead");
}

ConvergenceRecord by_density(const char* name, const char* map, double variance) {
  ConvergenceRecord r = estimator(-0.5, 1.0);
  r.estimator = name;
  r.map = map;
  r.predicted_variance = variance;
  return r;
}

TEST(DensityFinding, CountsWhereEachHasTheLeastVariance) {
  const std::vector<ConvergenceRecord> records = {
      by_density("uniform", "city", 0.01),        by_density("environment A", "city", 3.0),
      by_density("environment B", "city", 1.0),   by_density("environment C", "city", 1.5),
      by_density("environment A", "night", 0.25), by_density("environment C", "night", 0.5),
      by_density("environment B", "studio", 1.0)};
  const std::vector<DensityVariances> scenes = density_variances(records);
  ASSERT_EQ(scenes.size(), 2U) << "nothing is compared on the studio";
  EXPECT_EQ(scenes[0].scene->map, "city");
  EXPECT_EQ(scenes[0].variances, (std::array{3.0, 1.0, 1.5}));
  EXPECT_EQ(scenes[0].least, 1U);
  EXPECT_TRUE(std::isnan(scenes[1].variances[1]));
  EXPECT_EQ(scenes[1].least, 0U);
  EXPECT_EQ(density_finding(scenes),
            "Least exact variance of the densities of the map, over 2 scenes: A (texture-space) in "
            "1, B (solid-angle) in 1");
  EXPECT_EQ(density_finding({}), "");
}

TEST(ThroughputFinding, DoesNotClaimGrowthOrSpeedThatIsNotThere) {
  EXPECT_EQ(throughput_finding(speeds(400.0, 130.0)),
            "binary_search is 13 to 40 times as fast as linear_scan_published, from 512\u00d7256 "
            "to 1024\u00d7512");
  EXPECT_EQ(throughput_finding(speeds(5.0, 4.0)),
            "linear_scan_published takes 4 ns per sample on 1024\u00d7512")
      << "it is the fastest itself";
  EXPECT_EQ(throughput_finding({}), "Throughput was not measured");
}

TEST(RenderFinding, ComparesBestAndWorst) {
  RenderRecord good;
  good.estimator = "environment B";
  good.samples = 64;
  good.rmse = 0.02;
  RenderRecord bad = good;
  bad.estimator = "uniform";
  bad.rmse = 0.5;
  EXPECT_EQ(render_finding({&bad, &good}),
            "At 64 samples per pixel environment B has the smallest error, 2\u00a0% of the mean; "
            "that of uniform is 25 times as large");
  EXPECT_EQ(renders_finding({bad, good}), render_finding({&bad, &good}));
  RenderRecord timed = good;
  timed.point_seconds = 1.6e-5;
  EXPECT_EQ(render_finding({&timed}),
            "In about 16\u00a0\u00b5s a pixel environment B has the smallest error, 2\u00a0% of "
            "the mean");
  RenderRecord elsewhere = bad;
  elsewhere.map = "night";
  EXPECT_EQ(renders_finding({bad, good, elsewhere}),
            "Smallest error over 2 scenes: environment B in 1, uniform in 1");
}

TEST(MapFinding, ExplainsTheEffectiveFraction) {
  MapRecord map;
  map.effective_fraction = 0.02;
  EXPECT_EQ(map_finding(map),
            "The light counts as if it came evenly from 2\u00a0% of the sphere (its effective "
            "fraction), so directions drawn uniformly have a variance of 49 \u00d7 mean\u00b2 per "
            "sample; sampling the map pays off a lot.");
  map.effective_fraction = 1.0;
  EXPECT_EQ(map_finding(map),
            "The light counts as if it came evenly from 100\u00a0% of the sphere (its effective "
            "fraction), so directions drawn uniformly do as well as any.");
}

}  // namespace
}  // namespace lightproof
