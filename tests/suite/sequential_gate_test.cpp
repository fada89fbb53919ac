// The gate that stops as soon as it knows.
#include "lightproof/suite/sequential_gate.h"

#include <gtest/gtest.h>

#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/report/json.h"

namespace lightproof {
namespace {

constexpr Extent kExtent = {128, 64};

std::vector<Subject> sound_subjects() {
  std::vector<Subject> sound = all_subjects();
  std::erase_if(sound, [](const Subject& subject) { return subject.known_defects; });
  return sound;
}

/// binary_search under A that claims to be under B: a missing sin(theta).
Subject without_sine() {
  Subject subject = subject_of(sampler_by_name("binary_search"), Weighting::A);
  subject.target.weighting = Weighting::B;
  subject.inverts_shared_cdf = false;
  return subject;
}

bool is_sequential(const TestRecord& test) { return test.test == "sequential"; }

TEST(SequentialGate, RejectsWhatTheExactChecksFind) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  Subject subject = subject_of(sampler_by_name("binary_search"), Weighting::B);
  subject.bind = [bind = subject.bind](const EnvironmentMap& m) {
    const BoundSampler sound = bind(m);
    return BoundSampler{sound.sample,
                        [sound](SquarePoint at) { return PerSquare{2.0 * sound.pdf(at).value}; }};
  };
  const GateResult result =
      run_sequential_gate(problems_of({&map, 1}, {&subject, 1}), {.samples = 1U << 16U});
  EXPECT_EQ(result.tests[0].outcome, Outcome::accept);
  EXPECT_EQ(overall_outcome(result, true), Outcome::reject);
}

TEST(SequentialGate, AcceptsSoundSamplersAfterAllSamples) {
  std::vector<EnvironmentMap> maps;
  for (const SyntheticMap& entry : synthetic_maps()) maps.push_back(entry.make(kExtent));
  const std::vector<Subject> subjects = sound_subjects();
  const GateResult result =
      run_sequential_gate(problems_of(maps, subjects), {.samples = 1U << 18U});
  const auto counted = std::count_if(result.tests.begin(), result.tests.end(), is_sequential);
  EXPECT_EQ(static_cast<std::size_t>(counted), maps.size() * subjects.size());
  EXPECT_EQ(overall_outcome(result, true), Outcome::accept);
  EXPECT_TRUE(result.rejections.empty());
  for (const TestRecord& test : result.tests) EXPECT_EQ(test.samples, 1U << 18U);
}

// The evidence grows by about N w^2 / 2 nats; between the weightings of the constant map
// w^2 = sum over rows of q^2/p - 1 is 1, for 64 rows. So some hundred samples hold the 14 nats, and
// what the prior takes; a look at 2^14 is far beyond.
TEST(SequentialGate, StopsEarlyOnAWrongSamplerAndNamesIt) {
  const EnvironmentMap map = make_synthetic_map("constant", kExtent);
  const Subject subject = without_sine();
  const GateResult result = run_sequential_gate(problems_of({&map, 1}, {&subject, 1}), {});
  ASSERT_TRUE(is_sequential(result.tests[0]));
  EXPECT_EQ(result.tests[0].outcome, Outcome::reject);
  EXPECT_LE(result.tests[0].samples, 1U << 14U);
  ASSERT_EQ(result.rejections.size(), 1U);
  EXPECT_EQ(result.rejections[0].looks_like, "other-weighting");
}

// One black texel of a map whose texels are too many for a process of their own.
TEST(SequentialGate, StopsAtASampleWhereNoneCanLie) {
  static constexpr Extent kLarge = {512, 256};
  EnvironmentMap map = make_synthetic_map("constant", kLarge);
  map.radiance(300, 100) = Rgb(0.0F);
  Subject subject = subject_of(sampler_by_name("binary_search"), Weighting::B);
  subject.bind = [bind = subject.bind](const EnvironmentMap& m) {
    const BoundSampler sound = bind(m);
    return BoundSampler{[sound](auto points, auto samples) {
                          sound.sample(points, samples);
                          samples[0].x = 300;
                          samples[0].y = 100;
                          samples[0].at = {300.5 / kLarge.width, 100.5 / kLarge.height};
                        },
                        sound.pdf};
  };
  const GateResult result = run_sequential_gate(problems_of({&map, 1}, {&subject, 1}), {});
  EXPECT_EQ(result.tests[0].outcome, Outcome::reject);
  EXPECT_EQ(result.tests[0].samples, 1024U);
}

TEST(SequentialGate, TheSameJsonForAnyNumberOfThreads) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", kExtent);
  std::vector<Subject> subjects = sound_subjects();
  subjects.push_back(without_sine());
  const auto json = [&](int threads) {
    const ThreadLimit limit(threads);
    const GateResult result =
        run_sequential_gate(problems_of({&map, 1}, subjects), {.samples = 1000003});
    return gate_json(result, {overall_outcome(result, true), true}, {});
  };
  const std::string one = json(1);
  EXPECT_EQ(json(2), one);
  EXPECT_EQ(json(7), one);
}

}  // namespace
}  // namespace lightproof
