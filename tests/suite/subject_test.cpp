#include "lightproof/suite/subject.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lightproof/core/error.h"
#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {

AnySampler refuse(const EnvironmentMap& /*map*/, Weighting /*weighting*/) {
  throw InputError("another row");
}

// A user's row need not be one of the registry, nor live as long as what is made of it.
TEST(Subject, KeepsWhatItNeedsOfTheSampler) {
  SamplerInfo row = sampler_by_name("alias");
  const Subject subject = subject_of(row, Weighting::B);
  row.make = refuse;
  const EnvironmentMap map = make_synthetic_map("sun-sky", {16, 8});
  BoundSampler sampler;
  EXPECT_NO_THROW(sampler = subject.bind(map));
  EXPECT_GT(sampler.pdf({0.5, 0.75}).value, 0.0);
}

AnySampler run_out(const EnvironmentMap& /*map*/, Weighting /*weighting*/) {
  throw std::bad_alloc();
}

TEST(Subject, NamesTheMapThatMemoryDoesNotSufficeFor) {
  SamplerInfo row = sampler_by_name("alias");
  row.make = run_out;
  const std::vector<EnvironmentMap> maps = {make_synthetic_map("sun-sky", {16, 8})};
  const std::vector<Subject> subjects = {subject_of(row, Weighting::B)};
  const std::vector<Problem> problems = problems_of(maps, subjects);
  try {
    problems[0].candidates[0].bind();
    FAIL() << "nothing was thrown";
  } catch (const OutOfMemory& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("alias on sun-sky (16x8)"));
  }
}

}  // namespace
}  // namespace lightproof
