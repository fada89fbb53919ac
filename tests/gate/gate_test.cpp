// What the gate accepts, and how it goes about a rejection; what it must reject is in
// tests/mutants.
#include "lightproof/gate/gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <numeric>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/gate/direction_sampler.h"
#include "lightproof/gate/expectation.h"
#include "lightproof/gate/sequential_gate.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/report/json.h"
#include "tests/core/thorough.h"
#include "tests/gate/rejections.h"

namespace lightproof {
namespace {

constexpr Extent kExtent = {128, 64};

using test::rejections;

GateResult run_gate_on(std::span<const TestCase> test_cases) {
  return run_gate(test_cases, {.samples = 1024});
}
GateResult run_sequential_gate_on(std::span<const TestCase> test_cases) {
  return run_sequential_gate(test_cases, {.samples = 1024});
}

TEST(Gate, AcceptsCorrectSamplersOnEveryMapAndSize) {
  std::vector<SamplerUnderTest> correct = all_samplers_under_test();
  std::erase_if(correct,
                [](const SamplerUnderTest& under_test) { return under_test.known_defects; });
  for (const Extent extent : {Extent{1, 1}, Extent{2, 1}, Extent{5, 3}, Extent{128, 64}}) {
    std::vector<EnvironmentMap> maps;
    for (const SyntheticMap& entry : synthetic_maps()) maps.push_back(entry.make(extent));
    const GateResult result =
        run_gate(maps, correct, {.samples = test::is_thorough() ? 1U << 18U : 1U << 16U});
    EXPECT_EQ(overall_outcome(result, true), Outcome::accept)
        << extent.width << "x" << extent.height << ": "
        << testing::PrintToString(rejections(result));
  }
}

// Whatever part of a run it is that memory does not suffice for.
TEST(Gate, SaysWhereMemoryRanOut) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {16, 8});
  const std::vector<SamplerUnderTest> samplers_under_test = {
      sampler_under_test(sampler_by_name("alias"), DensitySpace::solid_angle)};
  std::vector<TestCase> test_cases = test_cases_of({&map, 1}, samplers_under_test);
  test_cases[0].instances[0].bind = [bind = test_cases[0].instances[0].bind] {
    return BoundSampler{
        [](std::span<const SquarePoint>, std::span<TexelSample>) { throw std::bad_alloc(); },
        bind().pdf};
  };
  for (const auto run : {run_gate_on, run_sequential_gate_on}) {
    try {
      run(test_cases);
      FAIL() << "memory sufficed";
    } catch (const OutOfMemory& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("sun-sky"));
    }
  }
}

TEST(Expectation, KurtosisInsideOneLitTexelIsThatOfAUniform) {
  // Under B cos(theta) is uniform in the texel and the estimator for +z is proportional to it:
  // the fourth central moment is 9/5 of the squared variance.
  for (const Extent extent : {Extent{128, 64}, Extent{256, 128}, Extent{512, 256}}) {
    const EnvironmentMap map = make_synthetic_map("one-texel", extent);
    const auto exact = expectation_of(map, {DensitySpace::solid_angle, kRec709}).estimators[0];
    EXPECT_NEAR(exact.fourth_central() / (exact.variance() * exact.variance()), 1.8, 1e-3);
  }
}

TEST(Gate, AcceptsCorrectSamplersOnOneLitTexelOfAnySize) {
  std::vector<SamplerUnderTest> correct = all_samplers_under_test();
  std::erase_if(correct,
                [](const SamplerUnderTest& under_test) { return under_test.known_defects; });
  for (const Extent extent : {Extent{256, 128}, Extent{512, 256}, Extent{1024, 512}}) {
    const EnvironmentMap map = make_synthetic_map("one-texel", extent);
    const GateResult result = run_gate({&map, 1}, correct, {.samples = 1U << 20U});
    EXPECT_EQ(overall_outcome(result, true), Outcome::accept)
        << extent.width << ": " << testing::PrintToString(rejections(result));
  }
}

TEST(Gate, RejectsThePublishedScanWhereTheFirstRowIsBlack) {
  const EnvironmentMap map = make_synthetic_map("black-first-row", kExtent);
  const SamplerUnderTest under_test =
      sampler_under_test(sampler_by_name("linear_scan_published"), DensitySpace::texture);
  const GateResult result = run_gate({&map, 1}, {&under_test, 1}, {.samples = 1U << 16U});
  EXPECT_THAT(rejections(result), testing::Contains("check/edges of u"));
  EXPECT_EQ(overall_outcome(result, true), Outcome::reject);
  EXPECT_EQ(overall_outcome(result, false), Outcome::inconclusive) << "nothing else decides";
}

TEST(Gate, TheLuminanceWeightsThatASamplerDeclaresAreHeldAgainstIt) {
  const EnvironmentMap map = make_synthetic_map("checker", kExtent);
  SamplerUnderTest under_test =
      sampler_under_test(sampler_by_name("binary_search"), DensitySpace::texture);
  under_test.target.weights = kPublishedLuminance;
  const GateResult result = run_gate({&map, 1}, {&under_test, 1}, {});
  EXPECT_THAT(rejections(result), testing::Contains("reference/bins 16x32"));
}

TEST(Gate, DensityAIsNotDensityB) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  SamplerUnderTest under_test =
      sampler_under_test(sampler_by_name("binary_search"), DensitySpace::texture);
  under_test.target.density_space = DensitySpace::solid_angle;  // a missing sin(theta)
  const GateResult result = run_gate({&map, 1}, {&under_test, 1}, {.samples = 1U << 16U});
  EXPECT_THAT(rejections(result), testing::Contains("reference/rows"));
}

/// Where it does not matter which densities they are: one with positions of either kind.
std::vector<SamplerUnderTest> all_samplers_of_two_densities() {
  std::vector<SamplerUnderTest> two = all_samplers_under_test();
  std::erase_if(two, [](const SamplerUnderTest& under_test) {
    return under_test.target.density_space == DensitySpace::texture;
  });
  return two;
}

TEST(Gate, ExposureChangesNoVerdict) {
  const std::vector<SamplerUnderTest> samplers_under_test = all_samplers_of_two_densities();
  const EnvironmentMap map = make_synthetic_map("sun-sky", kExtent);
  const auto outcomes_at = [&](float scale) {
    EnvironmentMap scaled = map;
    for (Rgb& rgb : scaled.radiance.values()) rgb *= scale;
    std::vector<Outcome> outcomes;
    for (const TestRecord& test :
         run_gate({&scaled, 1}, samplers_under_test, {.samples = 1U << 16U}).tests) {
      if (!test.known_defect) outcomes.push_back(test.outcome);
    }
    return outcomes;
  };
  const auto unscaled = outcomes_at(1.0F);
  EXPECT_EQ(outcomes_at(1e-9F), unscaled);
  EXPECT_EQ(outcomes_at(1e9F), unscaled);
}

TEST(Gate, TheSameJsonForAnyNumberOfThreads) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", kExtent);
  const std::vector<SamplerUnderTest> samplers_under_test = all_samplers_of_two_densities();
  const auto json = [&](int threads) {
    const ThreadLimit limit(threads);
    const GateResult result = run_gate({&map, 1}, samplers_under_test, {.samples = 1000003});
    return gate_json(result, {overall_outcome(result, false), false}, {});
  };
  const std::string one = json(1);
  EXPECT_EQ(json(2), one);
  EXPECT_EQ(json(7), one);
}

TEST(Gate, AcceptsEveryWarpAndMaterial) {
  const GateResult result = run_gate(test_cases_of(direction_samplers()), {.samples = 1U << 20U});
  EXPECT_EQ(overall_outcome(result, true), Outcome::accept)
      << testing::PrintToString(rejections(result));
  EXPECT_GE(result.tests.size(), 11U * 18U);
}

/// binary_search with a change to what it drew.
template <class Change>
SamplerUnderTest changed(const Change& change) {
  SamplerUnderTest under_test =
      sampler_under_test(sampler_by_name("binary_search"), DensitySpace::solid_angle);
  under_test.bind = [change, bind = under_test.bind](const EnvironmentMap& map) {
    const BoundSampler correct = bind(map);
    return BoundSampler{
        [correct, change](std::span<const SquarePoint> points, std::span<TexelSample> samples) {
          correct.sample(points, samples);
          for (TexelSample& sample : samples) change(sample);
        },
        correct.pdf};
  };
  return under_test;
}

TEST(Gate, FindsASingleTexelThatDiffersFromLinearScan) {
  const EnvironmentMap map = make_synthetic_map("constant", kExtent);
  const SamplerUnderTest under_test = changed([](TexelSample& sample) {
    if (sample.x != 77 || sample.y != 30) return;
    sample.x = 78;
    sample.at.s += 1.0 / kExtent.width;
  });
  const GateResult result = run_gate({&map, 1}, {&under_test, 1}, {.samples = 1U << 16U});
  EXPECT_THAT(rejections(result), testing::Contains("check/same texel as linear_scan"));
}

TEST(Gate, FindsASamplerThatDrawsAnotherDistributionThanItsReference) {
  const EnvironmentMap map = make_synthetic_map("constant", kExtent);
  const SamplerUnderTest under_test = changed([](TexelSample& sample) {
    if (sample.x >= 2) return;
    sample.x += 64;
    sample.at.s += 64.0 / kExtent.width;
  });
  const GateResult result = run_gate({&map, 1}, {&under_test, 1}, {.samples = 1U << 16U});
  EXPECT_THAT(rejections(result), testing::Contains("reference/two samples with linear_scan"));
}

// Densities 0.4 % too small: the mean of the estimator is 0.4 % too large. On the constant map and
// towards a pole X = 4 pi cos(theta)+ has a relative variance of 5/3: the deviation is 3.2 standard
// errors at 2^20 samples and 6.3 at 2^22. So the first stage, with 2^20, finds it below the
// screening level (3.3 standard errors) in 45 % of all runs, and the second, with 2^22, rejects it
// (5.2) in 87 % of those: of 40 runs one does, but for a probability of 3e-9.
TEST(Gate, ConfirmsWhatFallsBelowTheScreeningLevelWithFourTimesTheSamples) {
  const EnvironmentMap map = make_synthetic_map("constant", kExtent);
  const SamplerUnderTest under_test =
      changed([](TexelSample& sample) { sample.pdf.value /= 1.004; });
  int rejected_in_confirmation = 0;
  for (std::uint64_t seed = 1; seed <= 40 && rejected_in_confirmation == 0; ++seed) {
    const GateResult result =
        run_gate({&map, 1}, {&under_test, 1}, {.samples = 1U << 20U, .seed = seed});
    for (const TestRecord& test : result.tests) {
      if (test.test != TestId::irradiance_z_mean) continue;
      EXPECT_EQ(test.samples, test.stage == 2 ? 1U << 22U : 1U << 20U);
      rejected_in_confirmation += test.stage == 2 && test.outcome == Outcome::reject;
    }
  }
  EXPECT_EQ(rejected_in_confirmation, 1);
}

// Sums in steps of 2^-8: their own rounding makes an effect that is larger than what 2^20 samples
// can see, so an acceptance says nothing finer.
TEST(Gate, SaysWhereTheResolutionOfTheSamplerIsTheLimit) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  SamplerUnderTest under_test =
      sampler_under_test(sampler_by_name("binary_search"), DensitySpace::solid_angle);
  const auto texels = [&] {
    const GateResult result = run_gate({&map, 1}, {&under_test, 1}, {.samples = 1U << 20U});
    const TestRecord texels_of =
        *std::find_if(result.tests.begin(), result.tests.end(),
                      [](const TestRecord& test) { return test.test == TestId::texels; });
    EXPECT_EQ(overall_outcome(result, true), texels_of.outcome);
    return texels_of;
  };
  EXPECT_EQ(texels().outcome, Outcome::accept);
  under_test.resolution = 0x1p-8;
  const TestRecord coarse = texels();
  EXPECT_GT(*coarse.resolution_floor, *coarse.minimum_detectable_effect);
  EXPECT_EQ(coarse.outcome, Outcome::resolution_limited);
}

// A sampler is bound once for each stage: this one loses samples in the second only.
TEST(Gate, FailsForOutOfDomainSamplesOfTheSecondStageToo) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  SamplerUnderTest under_test =
      sampler_under_test(sampler_by_name("binary_search"), DensitySpace::solid_angle);
  under_test.inverts_shared_cdf = false;
  const auto bound = std::make_shared<int>(0);
  under_test.bind = [bound, bind = under_test.bind](const EnvironmentMap& m) {
    BoundSampler sampler = bind(m);
    if (++*bound < 2) return sampler;
    return BoundSampler{[sampler](auto points, auto samples) {
                          sampler.sample(points, samples);
                          samples[0].x = -1;
                        },
                        sampler.pdf};
  };
  const GateResult result =
      run_gate({&map, 1}, {&under_test, 1}, {.samples = 1U << 14U, .screening_level = 1.0});
  EXPECT_THAT(rejections(result), testing::Contains("check/no out-of-domain samples"));
  ASSERT_EQ(result.rejections.size(), 1U);
  EXPECT_EQ(result.rejections[0].looks_like, "off-the-map");
}

constexpr double kStep = 0x1p-24;
constexpr std::uint64_t kNoPools = std::uint64_t{1} << 60U;  // so many samples pool no cells

/// The shares of cells whose sums are rounded to kStep.
std::vector<double> rounded_shares(std::span<const double> masses) {
  const double total = std::accumulate(masses.begin(), masses.end(), 0.0);
  std::vector<double> shares;
  double sum = 0.0;
  double below = 0.0;
  for (const double mass : masses) {
    sum += mass;
    const double entry = std::round(sum / total / kStep) * kStep;
    shares.push_back(entry - below);
    below = entry;
  }
  return shares;
}

// The effect that rounding makes, against sums that are in fact rounded: to a float's step below 1,
// on a 128 x 64 map with a sun.
TEST(Expectation, RoundingEffectIsThatOfRoundedSums) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", kExtent);
  const Expectation expectation = expectation_of(map, {DensitySpace::solid_angle, kRec709});
  const std::vector<double> rows = rounded_shares(expectation.rows);
  double square = 0.0;
  for (int y = 0; y < kExtent.height; ++y) {
    const std::vector<double> shares = rounded_shares(expectation.masses.row(y));
    for (int x = 0; x < kExtent.width; ++x) {
      const double p = expectation.masses(x, y);
      const double q = rows[static_cast<std::size_t>(y)] * shares[static_cast<std::size_t>(x)];
      if (p > 0.0) square += (q - p) * (q - p) / p;
    }
  }
  // An average over the positions of 8192 CDF entries.
  const RoundingEffect expected = rounding_effect(expectation, kNoPools);
  EXPECT_NEAR(std::sqrt(square) / (expected.texels * kStep), 1.0, 0.2);
}

// Of 2048 rows. A row's error is the difference of two that are uniform: its square has a relative
// variance of 1.4, and neighbours, which share a CDF entry, a relative covariance of 0.2.
TEST(Expectation, RoundingEffectOfRowsIsThatOfRoundedSums) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {8, 2048});
  const Expectation expectation = expectation_of(map, {DensitySpace::texture, kRec709});
  const std::vector<double> rows = rounded_shares(expectation.rows);
  double square = 0.0;
  double sum = 0.0;
  double variance = 0.0;
  double before = 0.0;
  for (std::size_t y = 0; y < rows.size(); ++y) {
    const double weight = 1.0 / expectation.rows[y];
    const double error = (rows[y] - expectation.rows[y]) / kStep;
    square += error * error * weight;
    sum += weight / 6.0;
    variance += (1.4 * weight + 2.0 * 0.2 * before) * weight / 36.0;
    before = weight;
  }
  const double expected = std::pow(rounding_effect(expectation, kNoPools).rows, 2);
  EXPECT_NEAR(expected, sum, 1e-9 * sum);
  EXPECT_NEAR(square, sum, 5.0 * std::sqrt(variance));  // 6e-7, were it random
  EXPECT_LT(5.0 * std::sqrt(variance), 0.7 * sum) << "or it would say little";
}

TEST(Gate, TooFewSamplesAreInconclusive) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  const SamplerUnderTest under_test =
      sampler_under_test(sampler_by_name("binary_search"), DensitySpace::texture);
  const GateResult result = run_gate({&map, 1}, {&under_test, 1}, {.samples = 40});
  EXPECT_EQ(overall_outcome(result, true), Outcome::inconclusive);
}

TEST(Gate, PValuesOfACorrectSamplerAreUniform) {
  // 200 seeds; by DKW the largest deviation of their distribution from uniform exceeds
  // sqrt(ln(2/1e-6) / 400) = 0.191 with probability 1e-6 at most, for each of the tests.
  const EnvironmentMap map = make_synthetic_map("gradient", {32, 16});
  const SamplerUnderTest under_test =
      sampler_under_test(sampler_by_name("binary_search"), DensitySpace::solid_angle);
  std::map<TestId, std::vector<double>> p_values;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const GateResult result =
        run_gate({&map, 1}, {&under_test, 1}, {.samples = 16384, .seed = seed});
    for (const TestRecord& test : result.tests) {
      if (test.log10_p) p_values[test.test].push_back(std::pow(10.0, *test.log10_p));
    }
  }
  EXPECT_EQ(p_values.size(), 31U);
  for (auto& [test, values] : p_values) {
    std::sort(values.begin(), values.end());
    double deviation = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double n = static_cast<double>(values.size());
      deviation = std::max(deviation, static_cast<double>(i + 1) / n - values[i]);
      // The worst of many cells has a bound for its p-value: it may be larger, never smaller.
      if (describe(test).p_value_is_bound) continue;
      deviation = std::max(deviation, values[i] - static_cast<double>(i) / n);
    }
    EXPECT_LT(deviation, 0.191) << full_name(test);
  }
}

}  // namespace
}  // namespace lightproof
