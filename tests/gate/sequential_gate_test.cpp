// The gate that stops as soon as it knows.
#include "lightproof/gate/sequential_gate.h"

#include <gtest/gtest.h>

#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/report/json.h"
#include "tests/core/thorough.h"

namespace lightproof {
namespace {

constexpr Extent kExtent = {128, 64};

std::vector<SamplerUnderTest> correct_samplers() {
  std::vector<SamplerUnderTest> correct = all_samplers_under_test();
  std::erase_if(correct,
                [](const SamplerUnderTest& under_test) { return under_test.known_defects; });
  return correct;
}

/// binary_search under A that claims to be under B: a missing sin(theta).
SamplerUnderTest without_sine() {
  SamplerUnderTest under_test =
      sampler_under_test(sampler_by_name("binary_search"), DensitySpace::texture);
  under_test.name = "without_sine";
  under_test.target.density_space = DensitySpace::solid_angle;
  under_test.inverts_shared_cdf = false;
  return under_test;
}

bool is_sequential(const TestRecord& test) { return test.test == TestId::sequential; }

TEST(SequentialGate, RejectsWhatTheExactChecksFind) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  SamplerUnderTest under_test =
      sampler_under_test(sampler_by_name("binary_search"), DensitySpace::solid_angle);
  under_test.bind = [bind = under_test.bind](const EnvironmentMap& m) {
    const BoundSampler correct = bind(m);
    return BoundSampler{correct.sample, [correct](SquarePoint at) {
                          return PerSquare{2.0 * correct.pdf(at).value};
                        }};
  };
  const GateResult result =
      run_sequential_gate(test_cases_of({&map, 1}, {&under_test, 1}), {.samples = 1U << 16U});
  EXPECT_EQ(result.tests[0].outcome, Outcome::accept);
  EXPECT_EQ(overall_outcome(result, true), Outcome::reject);
}

TEST(SequentialGate, AcceptsCorrectSamplersAfterAllSamples) {
  std::vector<EnvironmentMap> maps;
  for (const SyntheticMap& entry : synthetic_maps()) maps.push_back(entry.make(kExtent));
  const std::vector<SamplerUnderTest> samplers_under_test = correct_samplers();
  const std::uint64_t samples = test::is_thorough() ? 1U << 18U : 1U << 16U;
  const GateResult result =
      run_sequential_gate(test_cases_of(maps, samplers_under_test), {.samples = samples});
  const auto counted = std::count_if(result.tests.begin(), result.tests.end(), is_sequential);
  EXPECT_EQ(static_cast<std::size_t>(counted), maps.size() * samplers_under_test.size());
  EXPECT_EQ(overall_outcome(result, true), Outcome::accept);
  EXPECT_TRUE(result.rejections.empty());
  for (const TestRecord& test : result.tests) EXPECT_EQ(test.samples, samples);
}

// The evidence grows by about N w^2 / 2 nats; between the densities of the constant map
// w^2 = sum over rows of q^2/p - 1 is 1, for 64 rows. So some hundred samples hold the 14 nats, and
// what the prior takes; a look at 2^14 is far beyond.
TEST(SequentialGate, StopsEarlyOnAWrongSamplerAndNamesIt) {
  const EnvironmentMap map = make_synthetic_map("constant", kExtent);
  const SamplerUnderTest under_test = without_sine();
  const GateResult result = run_sequential_gate(test_cases_of({&map, 1}, {&under_test, 1}), {});
  ASSERT_TRUE(is_sequential(result.tests[0]));
  EXPECT_EQ(result.tests[0].outcome, Outcome::reject);
  EXPECT_LE(result.tests[0].samples, 1U << 14U);
  ASSERT_EQ(result.rejections.size(), 1U);
  EXPECT_EQ(result.rejections[0].looks_like, "other-density");
}

// One black texel of a map whose texels are too many for a process of their own.
TEST(SequentialGate, StopsAtASampleWhereNoneCanLie) {
  static constexpr Extent kLarge = {512, 256};
  EnvironmentMap map = make_synthetic_map("constant", kLarge);
  map.radiance(300, 100) = Rgb(0.0F);
  SamplerUnderTest under_test =
      sampler_under_test(sampler_by_name("binary_search"), DensitySpace::solid_angle);
  under_test.bind = [bind = under_test.bind](const EnvironmentMap& m) {
    const BoundSampler correct = bind(m);
    return BoundSampler{[correct](auto points, auto samples) {
                          correct.sample(points, samples);
                          samples[0].x = 300;
                          samples[0].y = 100;
                          samples[0].at = {300.5 / kLarge.width, 100.5 / kLarge.height};
                        },
                        correct.pdf};
  };
  const GateResult result = run_sequential_gate(test_cases_of({&map, 1}, {&under_test, 1}), {});
  EXPECT_EQ(result.tests[0].outcome, Outcome::reject);
  EXPECT_EQ(result.tests[0].samples, 1024U);
}

TEST(SequentialGate, TheSameJsonForAnyNumberOfThreads) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", kExtent);
  std::vector<SamplerUnderTest> samplers_under_test = correct_samplers();
  // Whatever the densities are: one with positions of either kind.
  std::erase_if(samplers_under_test, [](const SamplerUnderTest& under_test) {
    return under_test.target.density_space == DensitySpace::texture;
  });
  samplers_under_test.push_back(without_sine());
  const auto json = [&](int threads) {
    const ThreadLimit limit(threads);
    const GateResult result =
        run_sequential_gate(test_cases_of({&map, 1}, samplers_under_test), {.samples = 1000003});
    return gate_json(result, {overall_outcome(result, true), true}, {});
  };
  const std::string one = json(1);
  EXPECT_EQ(json(2), one);
  EXPECT_EQ(json(7), one);
}

}  // namespace
}  // namespace lightproof
