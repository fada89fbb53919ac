// Dumps that are right are accepted, whatever their convention; those that are wrong are rejected,
// and what would make them right is recognised.
#include "lightproof/check/dump_test_case.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <tuple>

#include "lightproof/check/recognition.h"
#include "lightproof/core/error.h"
#include "lightproof/core/random.h"
#include "lightproof/image/largest_channel.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/results/verdict.h"
#include "lightproof/samplers/alias.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/warp/lat_long.h"
#include "tests/dump/files.h"

namespace lightproof {
namespace {

using testing::HasSubstr;

constexpr std::size_t kSamples = std::size_t{1} << 20U;

/// What a renderer would write of a sample: direction and density per steradian.
using Written = std::array<double, 4>;
using Change = std::function<void(Written&)>;

const EnvironmentMap& sun_sky() {
  static const EnvironmentMap map = make_synthetic_map("sun-sky", {256, 128});
  return map;
}

/// A sky that is blue below, red above and green on one side.
const EnvironmentMap& coloured_map() {
  static const EnvironmentMap map = [] {
    EnvironmentMap coloured = make_synthetic_map("constant", {64, 32});
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 64; ++x) {
        coloured.radiance(x, y) = {static_cast<float>(y) / 16.0F, static_cast<float>(x) / 32.0F,
                                   static_cast<float>(32 - y) / 16.0F};
      }
    }
    return coloured;
  }();
  return map;
}

/// Samples of a sampler that is right, as a file of floats, each changed as a defect would.
class Dump {
 public:
  explicit Dump(DensitySpace drawn, const Change& change = {}, SampleConvention convention = {},
                std::size_t samples = kSamples, bool with_pdf = true,
                const EnvironmentMap& map = sun_sky())
      : map_(&map) {
    const Alias sampler(map, on_map({drawn}, map));
    const RandomStream stream("dump", 7);
    const std::size_t columns = with_pdf ? 4 : 3;
    std::vector<float> numbers;
    numbers.reserve(samples * columns);
    for (std::size_t i = 0; i < samples; ++i) {
      const LightSample sample = sample_direction(sampler, stream.point(i));
      Written row = {sample.direction.x, sample.direction.y, sample.direction.z, sample.pdf.value};
      if (change) change(row);
      for (std::size_t k = 0; k < columns; ++k) numbers.push_back(static_cast<float>(row[k]));
    }
    const std::string shape = fmt::format("({}, {})", samples, columns);
    test::write_bytes(folder_ / "a.npy", test::npy_header("<f4", shape) + test::bytes_of(numbers));
    NumberTable table((folder_ / "a.npy").string(), std::nullopt, 0);
    dump_ = std::make_shared<const SampleDump>(
        std::move(table), sample_columns(default_columns(columns)), convention);
  }

  /// On the map that the samples are of.
  GateResult judged(DensitySpace declared) const { return judged_on(*map_, declared); }
  std::vector<Recognition> recognised(DensitySpace declared) const {
    return recognised_on(*map_, declared);
  }
  /// On another one.
  GateResult judged_on(const EnvironmentMap& map, DensitySpace declared) const {
    const TestCase test_case = dump_test_case(dump_, map, {"dump", {declared}});
    return run_gate({&test_case, 1}, spending({}, dump_->count()));
  }
  std::vector<Recognition> recognised_on(const EnvironmentMap& map, DensitySpace declared) const {
    return recognise(*dump_, DeclaredMap{&map, {declared}});
  }

 private:
  const EnvironmentMap* map_;
  TemporaryFolder folder_;
  std::shared_ptr<const SampleDump> dump_;
};

std::string rejected_tests(const GateResult& gate) {
  std::string text;
  for (const TestRecord& test : gate.tests) {
    if (test.outcome != Outcome::reject) continue;
    text += fmt::format("{}: {}; ", full_name(test.test), test.detail);
  }
  return text;
}

Outcome outcome_of(const GateResult& gate) { return overall_outcome(gate, false); }

TEST(Dump, OfEveryDensityIsAcceptedThoughFloatsMoveSamplesOverEdges) {
  for (const DensityInfo& density : kDensities) {
    const GateResult gate = Dump(density.density_space).judged(density.density_space);
    EXPECT_EQ(outcome_of(gate), Outcome::accept) << density.label << " " << rejected_tests(gate);
  }
}

/// Maps in every mapping but that of latitude and longitude.
const std::vector<EnvironmentMap>& own_texels() {
  static const std::vector<EnvironmentMap> maps = {
      make_synthetic_map("sun-sky", {128, 128}, {MappingKind::octahedral}),
      make_synthetic_map("sun-sky", {384, 64}, {MappingKind::cube_strip}),
      make_synthetic_map("sun-sky", {256, 129}, node_mapping({256, 129})),
      make_synthetic_map("sun-sky", {255, 128}, {.shift = 0.5 / 255})};
  return maps;
}

// As floats do, in the texels of the file: over the edges of faces and folds, too.
TEST(Dump, IsAcceptedInTheMapsOwnTexels) {
  for (const EnvironmentMap& map : own_texels()) {
    SCOPED_TRACE(describe(map.mapping));
    const Dump dump(DensitySpace::sine_weighted, {}, {}, kSamples, true, map);
    const GateResult gate = dump.judged(DensitySpace::sine_weighted);
    EXPECT_EQ(outcome_of(gate), Outcome::accept) << rejected_tests(gate);
  }
}

// Octahedral and of a cube: the other two have rows and columns as the plain ones have.
TEST(Dump, InOtherAxesIsRecognisedInTheMapsOwnTexels) {
  const Change flipped = [](Written& row) { row[2] = -row[2]; };
  for (const EnvironmentMap& map : std::span(own_texels()).first(2)) {
    SCOPED_TRACE(describe(map.mapping));
    const Dump dump(DensitySpace::sine_weighted, flipped, {}, kSamples, true, map);
    EXPECT_EQ(outcome_of(dump.judged(DensitySpace::sine_weighted)), Outcome::reject);
    const std::vector<Recognition> found = dump.recognised(DensitySpace::sine_weighted);
    ASSERT_FALSE(found.empty());
    EXPECT_THAT(found.front().words, HasSubstr("z is negated"));
  }
}

TEST(Dump, OfADensityThatTheTexelsCannotHaveIsRefused) {
  const EnvironmentMap& cube = own_texels()[1];
  const Dump dump(DensitySpace::sine_weighted, {}, {}, 500, true, cube);
  EXPECT_THAT([&] { dump.judged(DensitySpace::solid_angle); },
              testing::ThrowsMessage<InputError>(HasSubstr("no density B on its cube")));
}

TEST(Dump, WithoutDensitiesIsJudgedByItsDirections) {
  const Dump dump(DensitySpace::sine_weighted, {}, {}, kSamples, false);
  const GateResult gate = dump.judged(DensitySpace::sine_weighted);
  EXPECT_EQ(outcome_of(gate), Outcome::accept) << rejected_tests(gate);
  EXPECT_EQ(outcome_of(dump.judged(DensitySpace::texture)), Outcome::reject);
}

TEST(Dump, InTheAxesOfItsProgramIsAcceptedIfTheyAreNamed) {
  SampleConvention convention;
  convention.axes = axes_of(Preset::mitsuba);
  const auto to_y_up = [](Written& row) { row = {row[1], row[2], row[0], row[3]}; };
  const GateResult gate =
      Dump(DensitySpace::sine_weighted, to_y_up, convention).judged(DensitySpace::sine_weighted);
  EXPECT_EQ(outcome_of(gate), Outcome::accept) << rejected_tests(gate);
}

TEST(Dump, OfTooFewSamplesIsInconclusive) {
  const Dump dump(DensitySpace::sine_weighted, {}, {}, 500);
  EXPECT_EQ(outcome_of(dump.judged(DensitySpace::sine_weighted)), Outcome::inconclusive);
}

struct Mistake {
  const char* name;
  Change change;
  const char* options;  ///< that are recognised
};

TEST(Dump, InOtherAxesIsRejectedAndTheAxesAreRecognised) {
  const std::vector<Mistake> mistakes = {
      {"t flipped", [](Written& row) { row[2] = -row[2]; }, "--axes=x,y,-z"},
      {"s mirrored", [](Written& row) { row[1] = -row[1]; }, "--axes=x,-y,z"},
      {"half a turn",
       [](Written& row) {
         row = {-row[0], -row[1], row[2], row[3]};
       },
       "--axes=-x,-y,z"},
      {"y up",
       [](Written& row) {
         row = {row[1], row[2], row[0], row[3]};
       },
       "--axes=z,x,y"},
      {"left-handed", [](Written& row) { std::swap(row[1], row[2]); }, "--axes=x,z,y"}};
  for (const Mistake& mistake : mistakes) {
    const Dump dump(DensitySpace::sine_weighted, mistake.change);
    EXPECT_EQ(outcome_of(dump.judged(DensitySpace::sine_weighted)), Outcome::reject)
        << mistake.name;
    const auto found = dump.recognised(DensitySpace::sine_weighted);
    ASSERT_FALSE(found.empty()) << mistake.name;
    EXPECT_EQ(found.front().options, mistake.options) << mistake.name;
  }
}

// In the axes of the program, of which one was named wrongly.
TEST(Dump, IsAcceptedInTheAxesThatAreRecognised) {
  const auto as_written = [](Written& row) { row = {row[1], -row[2], row[0], row[3]}; };
  SampleConvention convention;
  convention.axes = axes_of(Preset::mitsuba);
  const auto found = Dump(DensitySpace::sine_weighted, as_written, convention)
                         .recognised(DensitySpace::sine_weighted);
  ASSERT_FALSE(found.empty());
  constexpr std::string_view kOption = "--axes=";
  ASSERT_TRUE(found.front().options.starts_with(kOption)) << found.front().options;
  convention.axes = AxisMap::parse(found.front().options.substr(kOption.size()));
  const GateResult gate =
      Dump(DensitySpace::sine_weighted, as_written, convention).judged(DensitySpace::sine_weighted);
  EXPECT_EQ(outcome_of(gate), Outcome::accept) << rejected_tests(gate);
}

TEST(Dump, OfAnotherDensityIsRejectedAndTheDensityIsRecognised) {
  const Dump dump(DensitySpace::texture);
  EXPECT_EQ(outcome_of(dump.judged(DensitySpace::sine_weighted)), Outcome::reject);
  const auto found = dump.recognised(DensitySpace::sine_weighted);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().options, "--density A");
}

/// Positions moved by parts of a texel of sun_sky(); what leaves it below or above stays at the
/// pole.
Change moved_by_texels(double s, double t) {
  return [=](Written& row) {
    SquarePoint at = square_from_direction({row[0], row[1], row[2]});
    at.s += s / 256.0;
    at.t = std::clamp(at.t + t / 128.0, 0.0, 1.0);
    const Direction d = direction_from_square(at);
    row = {d.x, d.y, d.z, row[3]};
  };
}

TEST(Dump, ThatIsHalfATexelOffIsRejectedAndTheShiftIsRecognised) {
  const std::vector<std::tuple<double, double, const char*>> shifts = {
      {0.5, 0.0, "if s decreases by half a texel"},
      {-0.5, 0.0, "if s increases by half a texel"},
      {0.0, 0.5, "if t decreases by half a texel"},
      {0.0, -0.5, "if t increases by half a texel"},
      {0.5, -0.5, "if s decreases by half a texel and t increases by half a texel"},
      {-0.5, -0.5, "if s increases by half a texel and t increases by half a texel"}};
  for (const auto& [s, t, words] : shifts) {
    const Dump dump(DensitySpace::sine_weighted, moved_by_texels(s, t));
    EXPECT_EQ(outcome_of(dump.judged(DensitySpace::sine_weighted)), Outcome::reject) << words;
    const auto found = dump.recognised(DensitySpace::sine_weighted);
    ASSERT_FALSE(found.empty()) << words;
    EXPECT_EQ(found.front().words, words);
    EXPECT_TRUE(found.front().options.empty()) << found.front().options;
  }
}

TEST(Dump, WhoseDensityLacksAJacobianIsRejectedAndTheJacobianIsRecognised) {
  const auto sine = [](const Written& row) { return std::hypot(row[0], row[1]); };
  const std::vector<std::tuple<Change, const char*, const char*>> mistakes = {
      {[=](Written& row) { row[3] *= 2.0 * kPi * kPi * sine(row); }, "is one over the unit square",
       "--measure square"},
      {[=](Written& row) { row[3] *= sine(row); }, "divided by sin(theta), which is forgotten", ""},
      {[](Written& row) { row[3] *= 2.0 * kPi * kPi; }, "divided by 2 pi^2", ""},
      {[=](Written& row) { row[3] *= 2.0 * kPi * kPi * sine(row) / (256.0 * 128.0); },
       "probability of the texel", ""},
      {[](Written& row) { row[3] *= 0.25; }, "divided by 0.25", ""}};
  for (const auto& [change, words, options] : mistakes) {
    const Dump dump(DensitySpace::sine_weighted, change);
    EXPECT_EQ(outcome_of(dump.judged(DensitySpace::sine_weighted)), Outcome::reject) << words;
    const auto found = dump.recognised(DensitySpace::sine_weighted);
    ASSERT_EQ(found.size(), 1U) << words;
    EXPECT_THAT(found.front().words, HasSubstr(words));
    EXPECT_EQ(found.front().options, options);
  }
}

TEST(Dump, OfAnotherLuminanceIsRejectedAndTheLuminanceIsRecognised) {
  const EnvironmentMap& coloured = coloured_map();
  const auto recognised = [&](const EnvironmentMap& drawn_of) {
    const Dump dump(DensitySpace::sine_weighted, {}, {}, kSamples, true, drawn_of);
    EXPECT_EQ(outcome_of(dump.judged_on(coloured, DensitySpace::sine_weighted)), Outcome::reject);
    const auto found = dump.recognised_on(coloured, DensitySpace::sine_weighted);
    return found.empty() ? std::string("nothing") : found.front().options;
  };
  EnvironmentMap by_average = coloured;
  by_average.weights = kAverageLuminance;
  EXPECT_EQ(recognised(by_average), "--luminance average");
  EXPECT_EQ(recognised(map_of_largest_channel(coloured)), "--luminance max");
}

TEST(Dump, ThatIsRightIsRecognisedAsNothingElse) {
  EXPECT_TRUE(Dump(DensitySpace::sine_weighted).recognised(DensitySpace::sine_weighted).empty());
}

TEST(Dump, WithAnotherDensityThanItsSamplesIsRejected) {
  const std::vector<std::pair<const char*, Change>> mistakes = {
      {"twice too large", [](Written& row) { row[3] *= 2.0; }},
      {"without its Jacobian", [](Written& row) { row[3] *= std::hypot(row[0], row[1]); }},
      {"a percent too large", [](Written& row) { row[3] *= 1.01; }},
      {"not a number once", [n = 0](Written& row) mutable {
         if (++n == 1000) row[3] = NAN;
       }}};
  for (const auto& [name, change] : mistakes) {
    const GateResult gate =
        Dump(DensitySpace::sine_weighted, change).judged(DensitySpace::sine_weighted);
    EXPECT_EQ(outcome_of(gate), Outcome::reject) << name;
  }
}

// Too few and too little for any statistic: each sample's density is compared.
TEST(Dump, WithADensityThatIsWrongNowAndThenIsRejectedByThatCheckAlone) {
  const Dump dump(DensitySpace::sine_weighted, [n = 0](Written& row) mutable {
    if (++n % 1000 == 0) row[3] *= 1.01;
  });
  for (const TestRecord& test : dump.judged(DensitySpace::sine_weighted).tests) {
    EXPECT_EQ(test.outcome == Outcome::reject, test.test == TestId::declared_density)
        << full_name(test.test) << ": " << test.detail;
  }
}

TEST(Dump, IsSpentInTwoStagesAFifthFirst) {
  EXPECT_EQ(spending({}, 1000).samples, 200U);
  EXPECT_EQ(spending({}, 1).samples, 1U);
  const Dump dump(DensitySpace::sine_weighted, [](Written& row) { row[2] = -row[2]; });
  for (const TestRecord& test : dump.judged(DensitySpace::sine_weighted).tests) {
    EXPECT_EQ(test.samples, (test.stage == 1 ? 1 : 4) * (kSamples / 5)) << full_name(test.test);
  }
}

TEST(Dump, WithDirectionsThatAreNoneIsRejected) {
  const Dump dump(DensitySpace::sine_weighted, [n = 0](Written& row) mutable {
    if (++n == 77) row = {2.0 * row[0], 2.0 * row[1], 2.0 * row[2], row[3]};
  });
  const GateResult gate = dump.judged(DensitySpace::sine_weighted);
  EXPECT_THAT(rejected_tests(gate), HasSubstr("first: sample 76, counted from 0,"));
}

TEST(Dump, ThatRepeatsItsSamplesIsRejected) {
  Written last = {};
  const Dump dump(DensitySpace::sine_weighted, [&, n = 0](Written& row) mutable {
    if (n++ % 4 == 1) row = last;
    last = row;
  });
  EXPECT_EQ(outcome_of(dump.judged(DensitySpace::sine_weighted)), Outcome::reject);
}

}  // namespace
}  // namespace lightproof
