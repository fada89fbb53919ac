// Samplers whose density is their own affair: right ones are accepted whatever they draw by, and
// densities, holes and weights that are wrong are found.
#include "lightproof/check/given_estimates.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/samplers/alias.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/warp/lat_long.h"
#include "tests/check/written_dump.h"

namespace lightproof {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t kSamples = 300'000;

/// Nearly all light comes from one texel.
const EnvironmentMap& sun() {
  static const EnvironmentMap map = make_synthetic_map("sun-sky", {128, 64});
  return map;
}

/// The same with a moderate sun.
const EnvironmentMap& sky() {
  static const EnvironmentMap map = [] {
    EnvironmentMap dimmed = sun();
    for (Rgb& rgb : dimmed.radiance.values()) rgb = glm::min(rgb, Rgb(4.0F));
    return dimmed;
  }();
  return map;
}

/// A sample, and the density with which it was drawn.
struct Drawn {
  Direction direction;
  double pdf;
};
/// Draws by a point of the square and a further random number.
using Draw = std::function<Drawn(SquarePoint, double)>;

Draw by_light(DensitySpace density, const EnvironmentMap& map = sky()) {
  const auto sampler = std::make_shared<const Alias>(map, TargetDensity{density});
  return [sampler](SquarePoint u, double) {
    const LightSample sample = sample_direction(*sampler, u);
    return Drawn{sample.direction, sample.pdf.value};
  };
}

Drawn uniform(SquarePoint u, double /*choice*/) {
  const double z = 2.0 * u.t - 1.0;
  const double sine = std::sqrt(std::max(0.0, (1.0 - z) * (1.0 + z)));
  return {{sine * std::cos(2.0 * kPi * u.s), sine * std::sin(2.0 * kPi * u.s), z}, 1.0 / kSphere};
}

/// Half by light, half uniformly: a defensive mixture.
Draw mixture() {
  const Alias sampler(sky(), {DensitySpace::sine_weighted});
  return [sampler](SquarePoint u, double choice) {
    Drawn drawn = uniform(u, 0.0);
    if (choice < 0.5) drawn.direction = sample_direction(sampler, u).direction;
    const SquarePoint at = square_from_direction(drawn.direction);
    drawn.pdf = 0.5 / kSphere + 0.5 * sampler.pdf(at).value / solid_angle_per_square(at.t);
    return drawn;
  };
}

Draw changed(const Draw& draw, const std::function<void(Drawn&)>& change) {
  return [=](SquarePoint u, double choice) {
    Drawn drawn = draw(u, choice);
    change(drawn);
    return drawn;
  };
}

/// Only the directions that are wanted: what is not is drawn again.
Draw only(const Draw& draw, const std::function<bool(Direction)>& wanted) {
  return [=, n = std::uint64_t{0}](SquarePoint u, double choice) mutable {
    Drawn drawn = draw(u, choice);
    const RandomStream more("more", 1);
    while (!wanted(drawn.direction)) {
      const SquarePoint other = more.point(n++);
      drawn = draw(other, more.point(n++).s);
    }
    return drawn;
  };
}

const std::vector<std::string> kWithPdf = {"x", "y", "z", "pdf"};

test::WrittenDump written(const Draw& draw, std::size_t samples = kSamples,
                          std::uint64_t seed = 5) {
  const RandomStream stream("estimates", seed);
  const RandomStream choices("choices", seed);
  return {samples, kWithPdf, [&](std::size_t i) {
            const auto [d, pdf] = draw(stream.point(i), choices.point(i).s);
            return std::vector<double>{d.x, d.y, d.z, pdf};
          }};
}

EstimateFindings judged(const test::WrittenDump& dump, bool judges_pdf = true,
                        const EnvironmentMap& map = sky()) {
  EstimateClaim claim = {};
  claim.name = "dump";
  claim.judges_pdf = judges_pdf;
  return judge_estimates(*dump.dump(), map, map, claim, {});
}

std::string found_by(const EstimateFindings& findings, Outcome outcome) {
  std::string text;
  for (const TestRecord& test : findings.tests) {
    if (test.outcome == outcome) text += fmt::format("{}: {}; ", full_name(test.test), test.detail);
  }
  return text;
}

TEST(GivenEstimates, OfARightSamplerAreAcceptedWhateverItDrawsBy) {
  const std::vector<std::pair<const char*, Draw>> right = {
      {"light, C", by_light(DensitySpace::sine_weighted)},
      {"light, A", by_light(DensitySpace::texture)},
      {"light, B", by_light(DensitySpace::solid_angle)},
      {"uniform", uniform},
      {"mixture", mixture()}};
  for (const auto& [name, draw] : right) {
    const EstimateFindings found = judged(written(draw));
    EXPECT_THAT(found_by(found, Outcome::reject), IsEmpty()) << name;
    EXPECT_THAT(found_by(found, Outcome::inconclusive), IsEmpty()) << name;
    EXPECT_TRUE(found.rejections.empty());
  }
}

// The sun is one texel of 8192: 2 of 20,000 samples of a uniform sampler find it, or none.
TEST(GivenEstimates, OfASamplerThatSeldomFindsTheSunAreNeverRejected) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    EXPECT_THAT(found_by(judged(written(uniform, 20'000, seed), true, sun()), Outcome::reject),
                IsEmpty())
        << seed;
  }
}

TEST(GivenEstimates, OfWrongDensitiesAreRejectedAndNamed) {
  struct Mistake {
    const char* name;
    Draw draw;
    const char* looks_like;
  };
  const Draw light = by_light(DensitySpace::sine_weighted);
  const auto scaled = [](const Draw& draw, double factor) {
    return changed(draw, [factor](Drawn& drawn) { drawn.pdf *= factor; });
  };
  const std::vector<Mistake> mistakes = {
      {"too large", scaled(light, 1.05), "pdf-too-large"},
      {"too small", scaled(light, 0.95), "pdf-too-small"},
      {"uniform, too large", scaled(uniform, 1.01), "pdf-too-large"},
      {"without sin(theta)",
       changed(light,
               [](Drawn& drawn) { drawn.pdf *= std::hypot(drawn.direction.x, drawn.direction.y); }),
       "pdf-too-small"},
      {"uniform, too small", scaled(uniform, 0.99), "pdf-too-small"},
      {"no number once",
       changed(light,
               [n = 0](Drawn& drawn) mutable {
                 if (++n == 150'000) drawn.pdf = NAN;
               }),
       "off-the-map"}};
  for (const Mistake& mistake : mistakes) {
    const EstimateFindings found = judged(written(mistake.draw));
    ASSERT_EQ(found.rejections.size(), 1U) << mistake.name;
    EXPECT_EQ(found.rejections.front().looks_like, mistake.looks_like)
        << mistake.name << ": " << found_by(found, Outcome::reject);
  }
}

TEST(GivenEstimates, OfFaultyRowsHaveTheirShareOfAllRows) {
  const auto share = [](int every) {
    const Draw draw = changed(uniform, [every, n = 0](Drawn& drawn) mutable {
      if (n++ % every == 0) drawn.pdf = 0.0;
    });
    const TestRecord record = judged(written(draw, 20'000)).tests.front();
    EXPECT_EQ(record.test, TestId::in_domain);
    EXPECT_EQ(record.samples, 20'000U);
    return record.effect;
  };
  EXPECT_EQ(share(1), 1.0);
  EXPECT_EQ(share(4), 0.25);
}

TEST(GivenEstimates, OfADensityOfOtherSamplesAreRejected) {
  // The samples of density A with the densities of C at their places.
  const Alias other(sky(), {DensitySpace::sine_weighted});
  const Draw draw = changed(by_light(DensitySpace::texture), [&other](Drawn& drawn) {
    const SquarePoint at = square_from_direction(drawn.direction);
    drawn.pdf = other.pdf(at).value / solid_angle_per_square(at.t);
  });
  EXPECT_THAT(found_by(judged(written(draw)), Outcome::reject), HasSubstr("by 1/pdf"));
}

TEST(GivenEstimates, OfASamplerWithAHoleNameTheHole) {
  const auto above = [](Direction d) { return d.z > 0.0; };
  const auto outside_of_a_block = [](Direction d) {
    const SquarePoint at = square_from_direction(d);
    return !(at.s > 0.5 && at.s < 0.53125 && at.t > 0.5 && at.t < 0.5625);
  };
  for (const auto& wanted :
       std::vector<std::function<bool(Direction)>>{above, outside_of_a_block}) {
    const EstimateFindings found = judged(written(only(uniform, wanted)));
    ASSERT_EQ(found.rejections.size(), 1U);
    EXPECT_EQ(found.rejections.front().looks_like, "hole") << found_by(found, Outcome::reject);
  }
}

TEST(GivenEstimates, OfTooFewSamplesAreInconclusive) {
  const EstimateFindings found = judged(written(by_light(DensitySpace::sine_weighted), 200));
  EXPECT_THAT(found_by(found, Outcome::reject), IsEmpty());
  EXPECT_THAT(found_by(found, Outcome::inconclusive), HasSubstr("draw more"));
}

// A sun that is never drawn may be one of a small density: the light says so, nothing can be
// proven.
TEST(GivenEstimates, OfASamplerThatNeverFindsMuchOfTheLightAreInconclusive) {
  const auto is_no_sun = [](Direction d) {
    const SquarePoint at = square_from_direction(d);
    const Rgb rgb = sun().radiance(cell_of(at.s, 128), cell_of(at.t, 64));
    return luminance_of(rgb) < 100.0;
  };
  const EstimateFindings found = judged(written(only(uniform, is_no_sun), 20'000), true, sun());
  EXPECT_THAT(found_by(found, Outcome::inconclusive) + found_by(found, Outcome::reject),
              HasSubstr("light that no sample reaches"));
}

/// Samples by light with weights, which `change` gets.
test::WrittenDump weighted(bool with_pdf, bool is_coloured,
                           const std::function<void(std::vector<double>&, std::size_t)>& change) {
  const Draw draw = by_light(DensitySpace::sine_weighted);
  const RandomStream stream("estimates", 5);
  std::vector<std::string> names = {"x", "y", "z"};
  if (with_pdf) names.emplace_back("pdf");
  for (const char* name : is_coloured ? std::vector{"wr", "wg", "wb"} : std::vector{"weight"}) {
    names.emplace_back(name);
  }
  return {kSamples, names, [&](std::size_t i) {
            const auto [d, pdf] = draw(stream.point(i), 0.0);
            const SquarePoint at = square_from_direction(d);
            const glm::dvec3 rgb = sky().radiance(cell_of(at.s, 128), cell_of(at.t, 64));
            std::vector<double> weights = {luminance_of(Rgb(rgb)) / pdf};
            if (is_coloured) weights = {rgb.r / pdf, rgb.g / pdf, rgb.b / pdf};
            if (change) change(weights, i);
            std::vector<double> row = {d.x, d.y, d.z};
            if (with_pdf) row.push_back(pdf);
            row.insert(row.end(), weights.begin(), weights.end());
            return row;
          }};
}

TEST(GivenEstimates, OfRightWeightsAreAccepted) {
  for (const bool with_pdf : {true, false}) {
    for (const bool is_coloured : {true, false}) {
      const EstimateFindings found = judged(weighted(with_pdf, is_coloured, {}), false);
      EXPECT_EQ(found.tests.size(), is_coloured ? 4U : 2U);
      EXPECT_THAT(found_by(found, Outcome::reject), IsEmpty());
      EXPECT_THAT(found_by(found, Outcome::inconclusive), IsEmpty());
    }
  }
}

TEST(GivenEstimates, OfWrongWeightsAreRejected) {
  using Weights = std::vector<double>;
  const std::vector<
      std::tuple<const char*, std::function<void(Weights&, std::size_t)>, const char*>>
      mistakes = {{"2 % too large",
                   [](Weights& w, std::size_t) {
                     for (double& v : w) v *= 1.02;
                   },
                   "light by the given weights"},
                  {"2 % too small",
                   [](Weights& w, std::size_t) {
                     for (double& v : w) v *= 0.98;
                   },
                   "light by the given weights"},
                  {"one that is negative",
                   [](Weights& w, std::size_t i) {
                     if (i == 77) w[0] = -w[0];
                   },
                   "first: sample 77"},
                  {"one that is infinite",
                   [](Weights& w, std::size_t i) {
                     if (i == 78) w[0] = INFINITY;
                   },
                   "first: sample 78"}};
  for (const auto& [name, change, found_in] : mistakes) {
    for (const bool with_pdf : {true, false}) {
      const EstimateFindings found = judged(weighted(with_pdf, false, change), false);
      EXPECT_THAT(found_by(found, Outcome::reject), HasSubstr(found_in)) << name;
    }
  }
}

TEST(GivenEstimates, OfWeightsThatAreNotLightOverPdfNowAndThenAreRejectedByThatCheckAlone) {
  const auto change = [](std::vector<double>& weights, std::size_t i) {
    if (i % 1000 == 0) weights[0] *= 1.01;
  };
  const EstimateFindings found = judged(weighted(true, false, change), false);
  EXPECT_THAT(found_by(found, Outcome::reject),
              testing::AllOf(HasSubstr("weight is L/pdf: 300 weights are off"),
                             testing::Not(HasSubstr("given weights"))));
}

TEST(GivenEstimates, OfAColouredWeightThatIsOffAreNamedWithTheChannelAndItsNumbers) {
  constexpr std::array kChannels = {"red", "green", "blue"};
  for (std::size_t channel = 0; channel < kChannels.size(); ++channel) {
    double given = 0.0;
    double right = 0.0;
    const auto change = [&](std::vector<double>& weights, std::size_t i) {
      if (i != 77) return;
      right = weights[channel];
      weights[channel] *= 3.0;
      given = weights[channel];
    };
    const EstimateFindings found = judged(weighted(true, true, change), false);
    const std::string words = found_by(found, Outcome::reject);
    const std::string before =
        fmt::format("sample 77, counted from 0: {} of the weight ", kChannels[channel]);
    ASSERT_THAT(words, HasSubstr(before));
    std::istringstream rest(words.substr(words.find(before) + before.size()));
    std::string word;
    double said = 0.0;
    double expected = 0.0;
    rest >> said >> word >> word >> word >> expected;
    // Six digits in the message, and floats in the file.
    constexpr double kRounded = 5e-6 + 2.0 * 0x1p-24;
    EXPECT_NEAR(said / given, 1.0, kRounded) << words;
    EXPECT_NEAR(expected / right, 1.0, kRounded) << words;
  }
}

TEST(GivenEstimates, OfColouredWeightsWithSwappedChannelsAreRejected) {
  const auto swapped = [](std::vector<double>& weights, std::size_t) {
    std::swap(weights[0], weights[2]);
  };
  const EstimateFindings found = judged(weighted(false, true, swapped), false);
  EXPECT_THAT(found_by(found, Outcome::reject), HasSubstr("blue light"));
}

}  // namespace
}  // namespace lightproof
