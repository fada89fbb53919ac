// Sources that cannot do everything: what they serve is tested, what they do not is recorded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <set>

#include "lightproof/core/parallel.h"
#include "lightproof/core/random_batch.h"
#include "lightproof/gate/gate.h"
#include "lightproof/gate/sequential_gate.h"
#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {

constexpr TargetDensity kTarget = {DensitySpace::solid_angle};
constexpr Extent kExtent = {64, 32};

/// Samples as somebody else's program would have written them: a fixed list, in an order.
struct Recording {
  std::vector<TexelSample> samples;
  std::function<PerSquare(SquarePoint)> pdf = {};
  bool has_weights = false;
};

std::vector<TexelSample> draw(const BoundSampler& sampler, std::uint64_t count,
                              std::uint64_t seed = 7) {
  std::vector<SquarePoint> points(count);
  fill_points(RandomStream("recorded elsewhere", seed), 0, points);
  std::vector<TexelSample> samples(count);
  sampler.sample(points, samples);
  return samples;
}

/// Is told of every stretch that is read: the first sample and how many.
using OnRead = std::function<void(std::uint64_t first, std::size_t count)>;

SamplerUnderTest recorded(const Recording& recording, const OnRead& on_read = {}) {
  return {.name = "recording",
          .target = kTarget,
          .bind =
              [&recording, on_read](const EnvironmentMap& /*map*/) {
                BoundSampler source;
                source.pdf = recording.pdf;
                source.sample_in_order = [&recording, on_read](std::uint64_t first,
                                                               std::span<TexelSample> samples) {
                  if (on_read) on_read(first, samples.size());
                  const auto begin = recording.samples.begin() + static_cast<std::ptrdiff_t>(first);
                  std::copy_n(begin, samples.size(), samples.begin());
                };
                source.count = recording.samples.size();
                source.has_weights = recording.has_weights;
                return source;
              },
          .resolution = 0.0};
}

BoundSampler binary_search_on(const EnvironmentMap& map) {
  return sampler_under_test(sampler_by_name("binary_search"), kTarget.density_space).bind(map);
}

GateResult judged(const EnvironmentMap& map, const Recording& recording, std::uint64_t samples,
                  const OnRead& on_read = {}) {
  const SamplerUnderTest source = recorded(recording, on_read);
  return run_gate({&map, 1}, {&source, 1}, {.samples = samples});
}

std::set<TestId> tests_with(const GateResult& result, Outcome outcome) {
  std::set<TestId> tests;
  for (const TestRecord& test : result.tests) {
    if (test.outcome == outcome) tests.insert(test.test);
  }
  return tests;
}

std::set<TestId> all_tests(const GateResult& result) {
  std::set<TestId> tests;
  for (const TestRecord& test : result.tests) tests.insert(test.test);
  return tests;
}

const std::set<TestId> kNeedPdf = {TestId::own_pdf_bins, TestId::pdf_integral, TestId::pdf_support,
                                   TestId::declared_density, TestId::returned_pdf};
const std::set<TestId> kNeedWeights = {
    TestId::irradiance_z_mean, TestId::irradiance_z_variance, TestId::irradiance_z_uniform,
    TestId::irradiance_x_mean, TestId::irradiance_x_variance, TestId::irradiance_x_uniform,
    TestId::inverse_pdf};
const std::set<TestId> kNeedPoints = {TestId::next_to_one, TestId::edge_points};

/// All of them but the positions, of which a recording may hold too few in a pole's row.
std::set<TestId> not_run_in(const GateResult& result) {
  std::set<TestId> tests = tests_with(result, Outcome::not_run);
  for (const TestId test : {TestId::positions_first_row, TestId::positions_last_row}) {
    tests.erase(test);
  }
  return tests;
}

std::set<TestId> united(std::initializer_list<std::set<TestId>> sets) {
  std::set<TestId> all;
  for (const std::set<TestId>& some : sets) all.insert(some.begin(), some.end());
  return all;
}

TEST(SampleSource, WithoutDensitiesIsAcceptedByWhatItServes) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  const Recording recording = {draw(binary_search_on(map), 1U << 20U)};
  const GateResult result = judged(map, recording, 1U << 20U);
  EXPECT_EQ(overall_outcome(result, true), Outcome::accept);
  EXPECT_EQ(not_run_in(result), united({kNeedPdf, kNeedWeights, kNeedPoints}));
}

TEST(SampleSource, WithPdfAndWeightsLacksTheGivenPointsAlone) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  const BoundSampler sampler = binary_search_on(map);
  const Recording recording = {draw(sampler, 1U << 20U), sampler.pdf, true};
  const GateResult result = judged(map, recording, 1U << 20U);
  EXPECT_EQ(overall_outcome(result, true), Outcome::accept);
  EXPECT_EQ(not_run_in(result), united({{TestId::returned_pdf}, kNeedPoints}));
}

// No test of a sampler that can do everything is missing from one that can not: it is not run.
TEST(SampleSource, LeavesOutNoTestInSilence) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  const SamplerUnderTest whole =
      sampler_under_test(sampler_by_name("alias"), kTarget.density_space);
  const GateResult everything = run_gate({&map, 1}, {&whole, 1}, {.samples = 1U << 18U});
  const Recording recording = {draw(binary_search_on(map), 1U << 18U)};
  EXPECT_EQ(all_tests(judged(map, recording, 1U << 18U)), all_tests(everything));
}

TEST(SampleSource, OfAnotherDistributionIsRejected) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  const SamplerUnderTest other =
      sampler_under_test(sampler_by_name("binary_search"), DensitySpace::texture);
  const Recording recording = {draw(other.bind(map), 1U << 18U)};
  const GateResult result = judged(map, recording, 1U << 18U);
  EXPECT_EQ(overall_outcome(result, true), Outcome::reject);
  ASSERT_EQ(result.rejections.size(), 1U);
  EXPECT_EQ(result.rejections[0].looks_like, "other-density");
}

// Every 46th sample of one half of the map lies in the other: Kuiper's statistic is then about 2.8
// in 2^16 samples, p = 1e-5, between the screening level and the immediate one, which it misses
// by 1.7 of its standard deviations of about 0.5 on one side. The samples that are left decide. Of
// eight recordings one comes to that, but for a probability of 1e-5.
TEST(SampleSource, IsConfirmedByTheSamplesThatAreLeft) {
  const EnvironmentMap map = make_synthetic_map("constant", kExtent);
  int confirmed = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    std::vector<TexelSample> samples = draw(binary_search_on(map), 5U << 16U, seed);
    for (std::size_t i = 0; i < samples.size(); i += 46) {
      TexelSample& sample = samples[i];
      if (sample.x < kExtent.width / 2) continue;
      sample.x -= kExtent.width / 2;
      sample.at.s -= 0.5;
    }
    std::mutex mutex;
    std::vector<int> reads(samples.size());
    const auto count = [&](std::uint64_t first, std::size_t size) {
      const std::lock_guard lock(mutex);
      for (std::size_t i = 0; i < size; ++i) ++reads[first + i];
    };
    const GateResult result = judged(map, {std::move(samples)}, 1U << 16U, count);
    EXPECT_EQ(std::ranges::max(reads), 1) << "a sample was used in both stages";
    for (const TestRecord& test : result.tests) {
      if (test.stage != 2) continue;
      EXPECT_EQ(test.samples, 4U << 16U);
      confirmed += test.outcome == Outcome::reject ? 1 : 0;
    }
  }
  EXPECT_GT(confirmed, 0);
}

TEST(SampleSource, ThatEndsEarlyIsJudgedByWhatThereIs) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  const Recording recording = {draw(binary_search_on(map), 100'000)};
  const GateResult result = judged(map, recording, 1U << 20U);
  for (const TestRecord& test : result.tests) EXPECT_EQ(test.samples, 100'000U);
  const GateResult more = judged(map, {draw(binary_search_on(map), 1U << 20U)}, 1U << 20U);
  EXPECT_GT(result.tests[0].minimum_detectable_effect.value(),
            2.0 * more.tests[0].minimum_detectable_effect.value());
}

TEST(SampleSource, IsReadByTheSequentialGate) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  const Recording recording = {draw(binary_search_on(map), 1U << 18U)};
  const SamplerUnderTest source = recorded(recording);
  const GateResult result =
      run_sequential_gate(test_cases_of({&map, 1}, {&source, 1}), {.samples = 1U << 20U});
  EXPECT_EQ(result.tests[0].samples, 1U << 18U);
  EXPECT_EQ(overall_outcome(result, true), Outcome::accept);
}

TEST(SampleSource, GivesTheSameForAnyNumberOfThreads) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", kExtent);
  const Recording recording = {draw(binary_search_on(map), 5U << 17U)};
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    std::vector<double> statistics;
    for (const TestRecord& test : judged(map, recording, 1U << 17U).tests) {
      statistics.push_back(test.statistic);
    }
    return statistics;
  };
  EXPECT_EQ(with(3), with(1));
}

}  // namespace
}  // namespace lightproof
