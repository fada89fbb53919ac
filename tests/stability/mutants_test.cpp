// Methods with one injected defect each fail the case that is about it: no case passes by saying
// nothing.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "lightproof/estimators/registry.h"
#include "lightproof/samplers/alias.h"
#include "lightproof/samplers/binary_search.h"
#include "lightproof/self_test/mutant.h"
#include "lightproof/stability/stability.h"

namespace lightproof {
namespace {

/// The record of a case for the one method that there is.
StabilityRecord record_of(const StabilityMethods& methods, int number) {
  const StabilityResult result = run_stability(methods, {.cases = {std::to_string(number)}});
  EXPECT_EQ(result.records.size(), 1U) << number;
  return result.records.empty() ? StabilityRecord{} : result.records.front();
}

struct Kill {
  int number;  ///< of the case
  std::string_view mutant;
  DensitySpace density_space = DensitySpace::solid_angle;
};

void PrintTo(const Kill& kill, std::ostream* out) { *out << kill.number << "_" << kill.mutant; }

class Mutants : public testing::TestWithParam<Kill> {};

TEST_P(Mutants, FailTheCaseThatIsAboutTheirDefect) {
  for (const Mutant& mutant : mutants()) {
    if (mutant.name != GetParam().mutant) continue;
    const StabilityRecord record = record_of(
        {.samplers = {sampler_under_test(mutant, GetParam().density_space)}}, GetParam().number);
    EXPECT_FALSE(passes(record)) << to_string(record.outcome) << ": " << record.came_out;
    return;
  }
  FAIL() << "no mutant " << GetParam().mutant;
}

INSTANTIATE_TEST_SUITE_P(SelfTest, Mutants,
                         testing::Values(Kill{1, "no-last-column"},
                                         Kill{7, "weights-2-percent-off"},
                                         Kill{8, "first-row-at-zero"}, Kill{9, "cdf-ends-early"},
                                         Kill{10, "abs-of-negative"}, Kill{11, "abs-of-negative"},
                                         Kill{12, "no-last-column"}, Kill{14, "nan-at-pole"},
                                         Kill{16, "pdf-of-neighbour"}, Kill{18, "no-last-column"},
                                         Kill{20, "no-last-column"},
                                         Kill{21, "t-flipped-in-sample"}, Kill{21, "u-mirrored"},
                                         Kill{34, "no-last-row"}, Kill{35, "other-luminance"},
                                         Kill{35, "bgr"}, Kill{38, "one-texel-missing"}));

/// A sampler with one thing changed about what it draws, or what it says.
struct Changed {
  std::string_view name;
  void (*sample)(TexelSample&) = nullptr;
  void (*pdf)(PerSquare&, SquarePoint) = nullptr;
};

SamplerUnderTest changed_sampler(const Changed& change) {
  return {.name = std::string(change.name),
          .target = {DensitySpace::texture},
          .bind = [change](const EnvironmentMap& map) {
            const BoundSampler right = bound(Alias(map, {DensitySpace::texture}));
            return BoundSampler{[right, change](std::span<const SquarePoint> points,
                                                std::span<TexelSample> samples) {
                                  right.sample(points, samples);
                                  if (change.sample == nullptr) return;
                                  for (TexelSample& sample : samples) change.sample(sample);
                                },
                                [right, change](SquarePoint at) {
                                  PerSquare density = right.pdf(at);
                                  if (change.pdf != nullptr) change.pdf(density, at);
                                  return density;
                                }};
          }};
}

TEST(ChangedSamplers, FailByTheNameOfTheirDefect) {
  const Changed no_density = {"p = 0", [](TexelSample& s) { s.pdf.value = 0.0; }};
  const Changed not_a_number = {"NaN", [](TexelSample& s) { s.at.s = std::nan(""); }};
  const Changed beyond = {"index N", [](TexelSample& s) { s.x = 1 << 20; }};
  for (const int number : {1, 8, 9, 10, 11, 14, 34, 36}) {
    EXPECT_EQ(record_of({.samplers = {changed_sampler(no_density)}}, number).outcome,
              StabilityOutcome::wrong)
        << number;
    EXPECT_EQ(record_of({.samplers = {changed_sampler(not_a_number)}}, number).outcome,
              StabilityOutcome::not_a_number)
        << number;
    EXPECT_EQ(record_of({.samplers = {changed_sampler(beyond)}}, number).outcome,
              StabilityOutcome::out_of_range)
        << number;
  }
  const Changed blind = {"blind", nullptr, [](PerSquare& p, SquarePoint) { p.value = 0.0; }};
  for (const int number : {2, 12, 13}) {
    EXPECT_EQ(record_of({.samplers = {changed_sampler(blind)}}, number).outcome,
              StabilityOutcome::wrong)
        << number;
  }
  const Changed infinite = {"infinite", nullptr, [](PerSquare& p, SquarePoint at) {
                              if (at.t == 0.0) p.value = HUGE_VAL;
                            }};
  EXPECT_EQ(record_of({.samplers = {changed_sampler(infinite)}}, 15).outcome,
            StabilityOutcome::not_a_number);
}

TEST(ChangedSamplers, FailIfAPositionLeavesItsTexelOrAThresholdIsAbsolute) {
  const Changed moved = {"moved", [](TexelSample& s) { s.at.s = std::fmod(s.at.s + 0.3, 1.0); }};
  EXPECT_EQ(record_of({.samplers = {changed_sampler(moved)}}, 17).outcome, StabilityOutcome::wrong);
  SamplerUnderTest absolute = changed_sampler({"absolute"});
  absolute.bind = [](const EnvironmentMap& map) {
    EnvironmentMap brighter = map;
    for (Rgb& rgb : brighter.radiance.values()) rgb = glm::max(rgb, Rgb(1e-4F));
    return bound(Alias(brighter, {DensitySpace::texture}));
  };
  EXPECT_EQ(record_of({.samplers = {absolute}}, 19).outcome, StabilityOutcome::wrong);
}

TEST(ChangedSamplers, FailOnABlackMapTheyTake) {
  SamplerUnderTest reckless = changed_sampler({"reckless"});
  reckless.bind = [](const EnvironmentMap&) {
    return BoundSampler{[](std::span<const SquarePoint>, std::span<TexelSample> samples) {
                          for (TexelSample& s : samples) s = {{NAN, NAN}, 0, 0, {NAN}};
                        },
                        [](SquarePoint) { return PerSquare{0.0}; }};
  };
  EXPECT_EQ(record_of({.samplers = {reckless}}, 3).outcome, StabilityOutcome::not_a_number);
  reckless.known_defects = true;
  for (const int number : {4, 5, 6}) {
    EXPECT_FALSE(passes(record_of({.samplers = {reckless}}, number))) << number;
  }
}

TEST(ChangedSamplers, ThatKeepTheFirstMapsTableFailOnTwo) {
  SamplerUnderTest stale = changed_sampler({"stale"});
  const auto kept = std::make_shared<std::shared_ptr<BoundSampler>>();
  stale.bind = [kept](const EnvironmentMap& map) {
    if (!*kept)
      *kept = std::make_shared<BoundSampler>(bound(BinarySearch(map, {DensitySpace::texture})));
    return **kept;
  };
  EXPECT_FALSE(passes(record_of({.samplers = {stale}}, 43)));
}

TEST(ChangedWarps, Fail) {
  const auto warp = [](auto sample, auto pdf) {
    return StabilityMethods{.warps = {{"changed", "", CosineLobes{}, sample, pdf}}};
  };
  const auto up = [](SquarePoint) { return DrawnDirection{{0.0, 0.0, 1.0}, {1.0}}; };
  const auto long_vector = [](SquarePoint) { return DrawnDirection{{0.0, 0.1, 1.0}, {1.0}}; };
  const auto nan_at_one = [](SquarePoint u) {
    return DrawnDirection{{0.0, 0.0, u.t == 1.0 ? std::nan("") : 1.0}, {1.0}};
  };
  const auto one = [](Direction) { return PerSteradian{1.0}; };
  const auto two = [](Direction) { return PerSteradian{2.0}; };
  EXPECT_TRUE(passes(record_of(warp(up, one), 8)));
  EXPECT_FALSE(passes(record_of(warp(long_vector, one), 8)));
  EXPECT_FALSE(passes(record_of(warp(nan_at_one, one), 9)));
  EXPECT_FALSE(passes(record_of(warp(up, two), 16)));
}

TEST(ChangedLobes, Fail) {
  const auto lobes = [](auto of_roughness, std::string parameter = {}) {
    return StabilityMethods{.lobes = {{"changed", of_roughness, std::move(parameter)}}};
  };
  const auto same = [](double) -> Material { return Ggx{0.5, 1.0}; };
  const auto broken = [](double) -> Material { return Ggx{std::nan(""), 1.0}; };
  EXPECT_FALSE(passes(record_of(lobes(same), 24))) << "no wider with roughness";
  for (const int number : {8, 9, 15, 16, 25}) {
    EXPECT_FALSE(passes(record_of(lobes(broken), number))) << number;
  }
}

TEST(ChangedFrames, Fail) {
  const auto frames = [](auto error) {
    return StabilityMethods{.frames = {{"changed", false, 0x1p-52, error}}};
  };
  EXPECT_TRUE(passes(record_of(frames([](Direction) { return 0.0; }), 26)));
  EXPECT_FALSE(passes(record_of(frames([](Direction) { return 1e-10; }), 26)));
  EXPECT_EQ(
      record_of(frames([](Direction n) { return n.z == 1.0 ? std::nan("") : 0.0; }), 26).outcome,
      StabilityOutcome::not_a_number);
}

TEST(ChangedTables, Fail) {
  const auto tables = [](auto at) {
    return StabilityMethods{.brdf_tables = {{"changed", false, at}}};
  };
  EXPECT_EQ(record_of(tables([](double mu, double) {
                        return ScaleBias{mu / mu, 0.0};
                      }),
                      25)
                .outcome,
            StabilityOutcome::not_a_number);
  EXPECT_EQ(record_of(tables([](double, double) {
                        return ScaleBias{1.1, 0.0};
                      }),
                      25)
                .outcome,
            StabilityOutcome::wrong);
}

TEST(ChangedMeans, Fail) {
  const auto mean = [](double value) {
    return StabilityMethods{
        .means = {{"changed", false, [value](std::uint64_t) { return value; }}}};
  };
  EXPECT_TRUE(passes(record_of(mean(1.0), 31)));
  EXPECT_FALSE(passes(record_of(mean(1.001), 31)));
}

Rgb nan_light(int /*call*/) { return Rgb(NAN); }
Rgb constant_light(int /*call*/) { return Rgb(1.0F); }
Rgb no_light(int /*call*/) { return Rgb(0.0F); }
Rgb ever_more_light(int call) { return Rgb(1.0F + 0.1F * static_cast<float>(call)); }

/// An estimator that gives the same light, whatever the map, until it is prepared again.
template <Rgb (*kLight)(int call)>
PreparedEstimator prepared(const EnvironmentMap& /*map*/) {
  static int call = 0;
  const Rgb light = kLight(call++);
  const auto integrate = [light](const ShadingPoint&, const RandomStream&, Budget,
                                 const EachEstimate&) { return light; };
  return {[integrate](const Scene&, const Material&) { return BoundEstimator{integrate}; }};
}

StabilityMethods estimator(PreparedEstimator (*make)(const EnvironmentMap&)) {
  EstimatorInfo info = estimator_by_name("mis balance compensated");
  info.make = make;
  return {.estimators = {info}};
}

TEST(ChangedEstimators, Fail) {
  for (const int number : {3, 34, 35, 36, 37, 43}) {
    EXPECT_EQ(record_of(estimator(prepared<nan_light>), number).outcome,
              StabilityOutcome::not_a_number)
        << number;
  }
  for (const int number : {3, 19, 35, 36}) {
    EXPECT_EQ(record_of(estimator(prepared<constant_light>), number).outcome,
              StabilityOutcome::wrong)
        << number;
  }
  EXPECT_EQ(record_of(estimator(prepared<no_light>), 37).outcome, StabilityOutcome::wrong);
  EXPECT_EQ(record_of(estimator(prepared<ever_more_light>), 43).outcome, StabilityOutcome::wrong);
}

StabilityMethods points(AnyPointSet (*make)(std::uint64_t, PointSeed)) {
  PointSetInfo info = point_set_by_name("R2");
  info.make = make;
  return {.point_sets = {info}};
}

TEST(ChangedPoints, Fail) {
  const auto decaying = [](std::uint64_t, PointSeed seed) -> AnyPointSet { return R2Float(seed); };
  EXPECT_EQ(record_of(points(decaying), 29).outcome, StabilityOutcome::wrong);
  const auto uneven = [](std::uint64_t count, PointSeed seed) -> AnyPointSet {
    return Hammersley(count, 0, seed);
  };
  EXPECT_EQ(record_of(points(uneven), 29).outcome, StabilityOutcome::wrong);
  const auto to_one = [](std::uint64_t count, PointSeed seed) -> AnyPointSet {
    return HammersleyFloat(count, seed);
  };
  EXPECT_EQ(record_of(points(to_one), 30).outcome, StabilityOutcome::out_of_range);
}

}  // namespace
}  // namespace lightproof
