// Processes that share the runs of a gate all find what one alone finds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "lightproof/core/random_batch.h"
#include "lightproof/gate/direction_sampler.h"
#include "lightproof/gate/gate.h"
#include "lightproof/gate/sequential_gate.h"
#include "lightproof/image/synthetic.h"
#include "tests/core/processes.h"

namespace lightproof {
namespace {

constexpr std::uint64_t kSamples = std::uint64_t{1} << 12U;

/// All that a gate found, to the last bit.
std::string bytes_of_result(const GateResult& result) {
  ValueWriter writer;
  writer.add(result.family);
  writer.add(result.tests);
  writer.add(result.rejections);
  return writer.take();
}

/// What alias draws, as a list that ends in the middle of the second stage.
SamplerUnderTest recording_of_alias() {
  SamplerUnderTest recording =
      sampler_under_test(sampler_by_name("alias"), DensitySpace::solid_angle);
  recording.name = "recording";
  recording.bind = [bind = recording.bind](const EnvironmentMap& map) {
    const BoundSampler alias = bind(map);
    BoundSampler source;
    source.pdf = alias.pdf;
    source.count = 3 * kSamples;
    source.sample_in_order = [alias](std::uint64_t first, std::span<TexelSample> samples) {
      std::vector<SquarePoint> points(samples.size());
      fill_points(RandomStream("recorded elsewhere", 7), first, points);
      alias.sample(points, samples);
    };
    return source;
  };
  return recording;
}

/// Samplers of which some are rejected in either stage, and a source that ends.
std::vector<SamplerUnderTest> samplers_under_test() {
  std::vector<SamplerUnderTest> all = all_samplers_under_test();
  SamplerUnderTest other_density =
      sampler_under_test(sampler_by_name("binary_search"), DensitySpace::texture);
  other_density.name = "other density";
  other_density.target.density_space = DensitySpace::solid_angle;
  all.push_back(other_density);
  all.push_back(recording_of_alias());
  return all;
}

/// The result of `run(maps, communicator)` at each process of 2, 3, 5 and 8, and alone.
template <class Run>
GateResult expect_the_same_in_processes(const Run& run) {
  std::vector<EnvironmentMap> maps;
  for (const char* name : {"black-first-row", "sun-sky"}) {
    maps.push_back(make_synthetic_map(name, {16, 8}));
  }
  std::vector<TestCase> test_cases = test_cases_of(maps, samplers_under_test());
  const std::vector<DirectionSamplerInfo> directions = {direction_samplers().front()};
  test_cases.push_back(test_cases_of(directions).front());
  const GateResult alone = run(test_cases, Communicator());
  const std::string bytes = bytes_of_result(alone);
  for (const std::size_t of : {2U, 3U, 5U, 8U}) {
    const auto found = test::in_processes(of, [&](const Communicator& communicator) {
      return bytes_of_result(run(test_cases, communicator));
    });
    for (std::size_t index = 0; index < of; ++index) {
      EXPECT_TRUE(found[index] == bytes) << "process " << index << " of " << of;
    }
  }
  return alone;
}

TEST(SharedRuns, AreScreenedConfirmedAndDiagnosedAsByOneProcess) {
  const GateResult result =
      expect_the_same_in_processes([](const auto& test_cases, const Communicator& communicator) {
        // So high a level takes many runs to the second stage.
        const GateOptions options = {.samples = kSamples, .screening_level = 0.1};
        return run_gate(test_cases, options, {}, communicator);
      });
  EXPECT_GT(std::count_if(result.tests.begin(), result.tests.end(),
                          [](const TestRecord& test) { return test.stage == 2; }),
            100);
  EXPECT_THAT(result.rejections,
              testing::Contains(testing::Field(&Rejection::sampler, "other density")));
}

TEST(SharedRuns, AreWatchedAndDiagnosedAsByOneProcess) {
  const GateResult result =
      expect_the_same_in_processes([](const auto& test_cases, const Communicator& communicator) {
        return run_sequential_gate(test_cases, {.samples = kSamples}, {}, communicator);
      });
  EXPECT_THAT(result.rejections,
              testing::Contains(testing::Field(&Rejection::sampler, "other density")));
}

// The tests of earlier runs stand for new ones: nothing is drawn but for a second stage or a
// diagnosis, and the result is the same to the last bit.
TEST(ScreenedRuns, AreNotScreenedAgain) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {16, 8});
  const std::vector<SamplerUnderTest> all = samplers_under_test();
  std::vector<TestCase> test_cases = test_cases_of({&map, 1}, all);
  const GateOptions options = {.samples = kSamples};
  const std::string whole = bytes_of_result(run_gate(test_cases, options));
  const ScreenedRuns screened = screen_runs(test_cases, options);
  EXPECT_EQ(screened.size(), all.size());
  std::atomic<int> bound = 0;
  for (TestCase& test_case : test_cases) {
    for (SamplerInstance& instance : test_case.instances) {
      instance.bind = [&bound, bind = instance.bind] {
        ++bound;
        return bind();
      };
    }
  }
  EXPECT_TRUE(bytes_of_result(run_gate(test_cases, options, {}, {}, screened)) == whole);
  const int again = bound;
  EXPECT_LT(again, static_cast<int>(all.size()) / 2);
  // Those of some runs alone, after a way through bytes.
  ScreenedRuns some = results_of<std::vector<Measured>>(bytes_of(screened));
  some.erase(some.begin());
  EXPECT_TRUE(bytes_of_result(run_gate(test_cases, options, {}, {}, some)) == whole);
  EXPECT_GT(bound, 2 * again);
}

// Runs that are computed one at a time, as those of large maps are, find the same.
TEST(RunsOfALargeMap, FindWhatThoseOfASmallOneDo) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {16, 8});
  const std::vector<TestCase> test_cases = test_cases_of({&map, 1}, samplers_under_test());
  std::vector<TestCase> large = test_cases;
  for (TestCase& test_case : large) {
    EXPECT_FALSE(test_case.is_large());
    test_case.texels = std::size_t{1} << 27U;
    EXPECT_TRUE(test_case.is_large());
  }
  const GateOptions options = {.samples = kSamples, .screening_level = 0.1};
  EXPECT_TRUE(bytes_of_result(run_gate(large, options)) ==
              bytes_of_result(run_gate(test_cases, options)));
  EXPECT_TRUE(bytes_of_result(run_sequential_gate(large, options)) ==
              bytes_of_result(run_sequential_gate(test_cases, options)));
}

TEST(SharedRuns, OfOneNameAreRefused) {
  const EnvironmentMap map = make_synthetic_map("constant", {8, 4});
  const SamplerUnderTest alias =
      sampler_under_test(sampler_by_name("alias"), DensitySpace::solid_angle);
  EXPECT_THROW(run_gate({&map, 1}, std::vector{alias, alias}, {.samples = 1024}), std::logic_error);
}

}  // namespace
}  // namespace lightproof
