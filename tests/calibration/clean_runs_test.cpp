// Two hundred runs of the whole gate over sound samplers, each with another base seed.
#include <gtest/gtest.h>

#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/suite/direction_sampler.h"
#include "lightproof/suite/gate.h"

namespace lightproof {
namespace {

/// All the light lies below the horizon but for one part in 1e5: a normal that looks up sees a rare
/// sample now and then, which proves nothing.
EnvironmentMap rarely_lit_map() {
  EnvironmentMap map = {"rarely lit", Grid<Rgb>({32, 16}), {}};
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) map.radiance(x, y) = Rgb(y == 3 ? 1e6F : 1.0F);
  }
  return map;
}

TEST(CleanRuns, NoneOfTwoHundredSeedsRejectsASoundSampler) {
  std::vector<EnvironmentMap> maps;
  for (const char* name : {"sun-sky", "black-first-row", "one-texel"}) {
    maps.push_back(make_synthetic_map(name, {32, 16}));
  }
  std::vector<Subject> sound = all_subjects();
  std::erase_if(sound, [](const Subject& subject) { return subject.known_defects; });
  maps.push_back(rarely_lit_map());
  std::vector<Problem> problems = problems_of(maps, sound, direction_samplers());
  for (Problem& problem : problems) problem = made_once(std::move(problem));
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const GateResult result = run_gate(problems, {.samples = 1U << 12U, .seed = seed});
    for (const TestRecord& test : result.tests) {
      EXPECT_NE(test.outcome, Outcome::reject)
          << test.sampler << " " << test.weighting << " on " << test.map << ": " << test.oracle
          << "/" << test.test << ", seed " << seed << ", " << test.detail;
    }
  }
}

}  // namespace
}  // namespace lightproof
