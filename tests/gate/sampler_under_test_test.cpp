#include "lightproof/gate/sampler_under_test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lightproof/core/error.h"
#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {

AnySampler refuse(const EnvironmentMap& /*map*/, DensitySpace /*density*/) {
  throw InputError("another row");
}

// A user's row need not be one of the registry, nor live as long as what is made of it.
TEST(SamplerUnderTest, KeepsWhatItNeedsOfTheSampler) {
  SamplerInfo row = sampler_by_name("alias");
  const SamplerUnderTest under_test = sampler_under_test(row, DensitySpace::solid_angle);
  row.make = refuse;
  const EnvironmentMap map = make_synthetic_map("sun-sky", {16, 8});
  BoundSampler sampler;
  EXPECT_NO_THROW(sampler = under_test.bind(map));
  EXPECT_GT(sampler.pdf({0.5, 0.75}).value, 0.0);
}

AnySampler run_out(const EnvironmentMap& /*map*/, DensitySpace /*density*/) {
  throw std::bad_alloc();
}

TEST(SamplerUnderTest, NamesTheMapThatMemoryDoesNotSufficeFor) {
  SamplerInfo row = sampler_by_name("alias");
  row.make = run_out;
  const std::vector<EnvironmentMap> maps = {make_synthetic_map("sun-sky", {16, 8})};
  const std::vector<SamplerUnderTest> samplers_under_test = {
      sampler_under_test(row, DensitySpace::solid_angle)};
  const std::vector<TestCase> test_cases = test_cases_of(maps, samplers_under_test);
  try {
    test_cases[0].instances[0].bind();
    FAIL() << "nothing was thrown";
  } catch (const OutOfMemory& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("alias on sun-sky (16x8)"));
  }
}

}  // namespace
}  // namespace lightproof
