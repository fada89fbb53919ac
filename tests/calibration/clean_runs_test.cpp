// Two hundred runs of the whole gate over sound samplers, each with another base seed.
#include <gtest/gtest.h>

#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/suite/gate.h"

namespace lightproof {
namespace {

TEST(CleanRuns, NoneOfTwoHundredSeedsRejectsASoundSampler) {
  std::vector<EnvironmentMap> maps;
  for (const SyntheticMap& entry : synthetic_maps()) maps.push_back(entry.make({32, 16}));
  std::vector<Subject> sound = all_subjects();
  std::erase_if(sound, [](const Subject& subject) { return subject.known_defects; });
  std::vector<Problem> problems = problems_of(maps, sound);
  // The exact side does not depend on the seed: it is made once.
  for (Problem& problem : problems) {
    const auto expectation = std::make_shared<const Expectation>(problem.expectation());
    problem.expectation = [expectation] { return *expectation; };
  }
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const GateResult result = run_gate(problems, {.samples = 1U << 13U, .seed = seed});
    for (const TestRecord& test : result.tests) {
      EXPECT_NE(test.outcome, Outcome::reject)
          << test.sampler << " " << test.weighting << " on " << test.map << ": " << test.oracle
          << "/" << test.test << ", seed " << seed << ", " << test.detail;
    }
  }
}

}  // namespace
}  // namespace lightproof
