// What the gate accepts, and what it must reject: every test of the gate has a planted defect that
// it, by name, has to find.
#include "lightproof/suite/gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/report/json.h"
#include "lightproof/suite/expectation.h"

namespace lightproof {
namespace {

constexpr Extent kExtent = {128, 64};

/// A change that turns a sound sampler into a mutant.
struct Defect {
  std::string name;
  std::string found_by;  ///< "oracle/test" that must reject it
  /// Changes the point before, or the sample after, sampling.
  std::function<SquarePoint(SquarePoint)> before;
  std::function<void(TexelSample&, Extent)> after;
  std::function<PerSquare(PerSquare)> pdf;
};

void move_to(TexelSample& sample, Extent extent, int x, int y) {
  sample.at = {place_in_cell(x, 0.5, extent.width), place_in_cell(y, 0.5, extent.height)};
  sample.x = x;
  sample.y = y;
}

const std::vector<Defect>& defects() {
  static const std::vector<Defect> all = {
      {"t flipped in the sample",
       "reference/bins 16x32",
       {},
       [](TexelSample& s, Extent e) {
         s.at.t = 1.0 - s.at.t;
         s.y = e.height - 1 - s.y;
       },
       {}},
      {"u mirrored",
       "reference/columns",
       {},
       [](TexelSample& s, Extent e) {
         s.at.s = 1.0 - s.at.s;
         s.x = e.width - 1 - s.x;
       },
       {}},
      {"first row never drawn",
       "reference/rows",
       {},
       [](TexelSample& s, Extent e) {
         if (s.y == 0) move_to(s, e, s.x, 1);
       },
       {}},
      {"last column never drawn",
       "reference/columns",
       {},
       [](TexelSample& s, Extent e) {
         if (s.x == e.width - 1) move_to(s, e, 0, s.y);
       },
       {}},
      {"the same number for both dimensions",
       "reference/bins 16x32",
       [](SquarePoint u) {
         return SquarePoint{u.t, u.t};
       },
       {},
       {}},
      {"a returned pdf a hair too large",
       "check/pdf of the sample",
       {},
       [](TexelSample& s, Extent) { s.pdf.value *= 1.0001; },
       {}},
      {"pdf twice too large",
       "check/pdf integrates to 1",
       {},
       [](TexelSample& s, Extent) { s.pdf.value *= 2.0; },
       [](PerSquare p) { return PerSquare{2.0 * p.value}; }},
      {"weights two percent off",
       "mean/irradiance, normal +z",
       {},
       [](TexelSample& s, Extent) { s.pdf.value *= 1.02; },
       [](PerSquare p) { return PerSquare{1.02 * p.value}; }},
      {"weights noisy but right in the mean",
       "variance/irradiance, normal +x",
       {},
       [](TexelSample& s, Extent) { s.pdf.value /= s.x % 2 == 0 ? 1.1 : 0.9; },
       {}},
      {"1/pdf off where it is bright",
       "self/mean of 1/pdf",
       {},
       [](TexelSample& s, Extent) { s.pdf.value *= 1.02; },
       {}},
      {"a place outside the texel",
       "check/edges of u",
       {},
       [](TexelSample& s, Extent e) { s.at.s = std::fmod(s.at.s + 0.6 / e.width, 1.0); },
       {}},
      {"one in some thousand lost",
       "check/samples stay on the map",
       {},
       [](TexelSample& s, Extent e) {
         if (s.at.s < 1e-4) s.x = e.width;
       },
       {}},
      {"another texel than linear_scan",
       "check/same texel as linear_scan",
       {},
       [](TexelSample& s, Extent e) {
         if (s.x == 77 && s.y == 30) move_to(s, e, 78, 30);
       },
       {}},
  };
  return all;
}

/// binary_search with a defect.
Subject with_defect(const Defect& defect, Weighting weighting) {
  Subject subject = subject_of(sampler_by_name("binary_search"), weighting);
  const auto bind = subject.bind;
  subject.name = defect.name;
  subject.bind = [bind, defect](const EnvironmentMap& map) {
    const BoundSampler sound = bind(map);
    const Extent extent = map.radiance.extent();
    BoundSampler mutant;
    mutant.sample = [sound, defect, extent](std::span<const SquarePoint> points,
                                            std::span<TexelSample> samples) {
      std::vector<SquarePoint> changed(points.begin(), points.end());
      if (defect.before)
        std::transform(points.begin(), points.end(), changed.begin(), defect.before);
      sound.sample(changed, samples);
      if (!defect.after) return;
      for (TexelSample& sample : samples) defect.after(sample, extent);
    };
    mutant.pdf = [sound, defect](SquarePoint at) {
      return defect.pdf ? defect.pdf(sound.pdf(at)) : sound.pdf(at);
    };
    return mutant;
  };
  return subject;
}

std::vector<std::string> rejections(const GateResult& result) {
  std::vector<std::string> names;
  for (const TestRecord& test : result.tests) {
    if (test.outcome == Outcome::reject) names.push_back(test.oracle + "/" + test.test);
  }
  return names;
}

class GateOnDefects : public testing::TestWithParam<std::tuple<std::size_t, Weighting>> {};

TEST_P(GateOnDefects, IsFoundByItsTest) {
  const auto [index, weighting] = GetParam();
  const Defect& defect = defects()[index];
  // A bright side, so that mirroring shows, and no texel too faint to be drawn.
  EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  for (int y = 0; y < kExtent.height; ++y) {
    for (int x = 0; x < kExtent.width / 4; ++x) map.radiance(x, y) *= 1.5F;
  }
  const Subject subject = with_defect(defect, weighting);
  const GateResult result = run_gate({&map, 1}, {&subject, 1}, {});
  EXPECT_EQ(overall_outcome(result, true), Outcome::reject);
  EXPECT_THAT(rejections(result), testing::Contains(defect.found_by)) << defect.name;
}

INSTANTIATE_TEST_SUITE_P(All, GateOnDefects,
                         testing::Combine(testing::Range<std::size_t>(0, 13),
                                          testing::Values(Weighting::A, Weighting::B)),
                         [](const auto& param_info) {
                           std::string name = defects()[std::get<0>(param_info.param)].name;
                           std::replace_if(
                               name.begin(), name.end(),
                               [](char c) { return std::isalnum(c) == 0; }, '_');
                           return name + "_" + to_string(std::get<1>(param_info.param));
                         });

TEST(Gate, EveryDefectIsTried) { EXPECT_EQ(defects().size(), 13U); }

TEST(Gate, AcceptsSoundSamplersOnEveryMapAndSize) {
  std::vector<Subject> sound = all_subjects();
  std::erase_if(sound, [](const Subject& subject) { return subject.known_defects; });
  for (const Extent extent : {Extent{1, 1}, Extent{2, 1}, Extent{5, 3}, Extent{128, 64}}) {
    std::vector<EnvironmentMap> maps;
    for (const SyntheticMap& entry : synthetic_maps()) maps.push_back(entry.make(extent));
    const GateResult result = run_gate(maps, sound, {.samples = 1U << 18U});
    EXPECT_EQ(overall_outcome(result, true), Outcome::accept)
        << extent.width << "x" << extent.height << ": "
        << testing::PrintToString(rejections(result));
  }
}

TEST(Expectation, KurtosisInsideOneLitTexelIsThatOfAUniform) {
  // Under B cos(theta) is uniform in the texel and the estimator for +z is proportional to it:
  // the fourth central moment is 9/5 of the squared variance.
  for (const Extent extent : {Extent{128, 64}, Extent{256, 128}, Extent{512, 256}}) {
    const EnvironmentMap map = make_synthetic_map("one-texel", extent);
    const auto& exact = expectation_of(map, {Weighting::B, kRec709}).estimators[0];
    EXPECT_NEAR(exact.fourth_central() / (exact.variance() * exact.variance()), 1.8, 1e-3);
  }
}

TEST(Gate, AcceptsSoundSamplersOnOneLitTexelOfAnySize) {
  std::vector<Subject> sound = all_subjects();
  std::erase_if(sound, [](const Subject& subject) { return subject.known_defects; });
  for (const Extent extent : {Extent{256, 128}, Extent{512, 256}, Extent{1024, 512}}) {
    const EnvironmentMap map = make_synthetic_map("one-texel", extent);
    const GateResult result = run_gate({&map, 1}, sound, {.samples = 1U << 20U});
    EXPECT_EQ(overall_outcome(result, true), Outcome::accept)
        << extent.width << ": " << testing::PrintToString(rejections(result));
  }
}

TEST(Gate, RejectsThePublishedScanWhereTheFirstRowIsBlack) {
  const EnvironmentMap map = make_synthetic_map("black-first-row", kExtent);
  const Subject subject = subject_of(sampler_by_name("linear_scan_published"), Weighting::A);
  const GateResult result = run_gate({&map, 1}, {&subject, 1}, {.samples = 1U << 16U});
  EXPECT_THAT(rejections(result), testing::Contains("check/edges of u"));
  EXPECT_EQ(overall_outcome(result, true), Outcome::reject);
  EXPECT_EQ(overall_outcome(result, false), Outcome::accept) << "its defects are known";
}

TEST(Gate, TheGreyWeightsThatASamplerDeclaresAreHeldAgainstIt) {
  const EnvironmentMap map = make_synthetic_map("checker", kExtent);
  Subject subject = subject_of(sampler_by_name("binary_search"), Weighting::A);
  subject.target.grey = kPublishedLuminance;
  const GateResult result = run_gate({&map, 1}, {&subject, 1}, {});
  EXPECT_THAT(rejections(result), testing::Contains("reference/bins 16x32"));
}

TEST(Gate, WeightingAIsNotWeightingB) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  Subject subject = subject_of(sampler_by_name("binary_search"), Weighting::A);
  subject.target.weighting = Weighting::B;  // a missing sin(theta)
  const GateResult result = run_gate({&map, 1}, {&subject, 1}, {.samples = 1U << 16U});
  EXPECT_THAT(rejections(result), testing::Contains("reference/rows"));
}

TEST(Gate, ExposureChangesNoVerdict) {
  const std::vector<Subject> subjects = all_subjects();
  const EnvironmentMap map = make_synthetic_map("sun-sky", kExtent);
  const auto outcomes_at = [&](float scale) {
    EnvironmentMap scaled = map;
    for (Rgb& rgb : scaled.radiance.values()) rgb *= scale;
    std::vector<Outcome> outcomes;
    for (const TestRecord& test : run_gate({&scaled, 1}, subjects, {.samples = 1U << 16U}).tests) {
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
  const std::vector<Subject> subjects = all_subjects();
  const auto json = [&](int threads) {
    const ThreadLimit limit(threads);
    const GateResult result = run_gate({&map, 1}, subjects, {.samples = 1000003});
    return gate_json(result, overall_outcome(result, false));
  };
  const std::string one = json(1);
  EXPECT_EQ(json(2), one);
  EXPECT_EQ(json(7), one);
}

TEST(Gate, TooFewSamplesAreInconclusive) {
  const EnvironmentMap map = make_synthetic_map("gradient", kExtent);
  const Subject subject = subject_of(sampler_by_name("binary_search"), Weighting::A);
  const GateResult result = run_gate({&map, 1}, {&subject, 1}, {.samples = 40});
  EXPECT_EQ(overall_outcome(result, true), Outcome::inconclusive);
}

TEST(Gate, PValuesOfASoundSamplerAreUniform) {
  // 200 seeds; by DKW the largest deviation of their distribution from uniform exceeds
  // sqrt(ln(2/1e-6) / 400) = 0.191 with probability 1e-6 at most, for each of the tests.
  const EnvironmentMap map = make_synthetic_map("gradient", {32, 16});
  const Subject subject = subject_of(sampler_by_name("binary_search"), Weighting::B);
  std::map<std::string, std::vector<double>> p_values;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const GateResult result = run_gate({&map, 1}, {&subject, 1}, {.samples = 16384, .seed = seed});
    for (const TestRecord& test : result.tests) {
      if (test.log10_p) p_values[test.oracle + test.test].push_back(std::pow(10.0, *test.log10_p));
    }
  }
  EXPECT_EQ(p_values.size(), 16U);
  for (auto& [name, values] : p_values) {
    std::sort(values.begin(), values.end());
    double deviation = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double n = static_cast<double>(values.size());
      deviation = std::max(deviation, static_cast<double>(i + 1) / n - values[i]);
      // The worst of many cells has a bound for its p-value: it may be larger, never smaller.
      if (name.find("worst") != std::string::npos) continue;
      deviation = std::max(deviation, values[i] - static_cast<double>(i) / n);
    }
    EXPECT_LT(deviation, 0.191) << name;
  }
}

}  // namespace
}  // namespace lightproof
