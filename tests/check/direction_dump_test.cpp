// Samples of hemispheres, lobes, microfacets and phase functions, as other programs write them:
// right ones are accepted, and what is wrong with others is named.
#include "lightproof/check/direction_dump.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "lightproof/check/recognition.h"
#include "lightproof/core/error.h"
#include "lightproof/core/random.h"
#include "lightproof/gate/gate.h"
#include "lightproof/materials/material.h"
#include "lightproof/results/verdict.h"
#include "tests/check/written_dump.h"

namespace lightproof {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t kSamples = 300'000;
const std::vector<std::string> kColumns = {"x", "y", "z", "pdf"};

Direction at_height(double z, double turn) {
  const double sine = std::sqrt(std::max(0.0, (1.0 - z) * (1.0 + z)));
  return {sine * std::cos(2.0 * kPi * turn), sine * std::sin(2.0 * kPi * turn), z};
}

struct Drawn {
  Direction direction;
  double pdf;
};
using Draw = std::function<Drawn(SquarePoint)>;

Drawn uniform(SquarePoint u) { return {at_height(2.0 * u.t - 1.0, u.s), 1.0 / (4.0 * kPi)}; }
Drawn hemisphere(SquarePoint u) { return {at_height(u.t, u.s), 1.0 / (2.0 * kPi)}; }
Drawn cosine(SquarePoint u) {
  const double z = std::sqrt(u.t);
  return {at_height(z, u.s), z / kPi};
}

Draw phong(double exponent) {
  return [exponent](SquarePoint u) {
    const double z = std::pow(u.t, 1.0 / (exponent + 1.0));
    return Drawn{at_height(z, u.s), (exponent + 1.0) / (2.0 * kPi) * std::pow(z, exponent)};
  };
}

/// By the textbook's formula (Witt 1977).
Draw henyey_greenstein(double g) {
  return [g](SquarePoint u) {
    const double square = (1.0 - g * g) / (1.0 - g + 2.0 * g * u.t);
    const double z = (1.0 + g * g - square * square) / (2.0 * g);
    return Drawn{at_height(z, u.s),
                 (1.0 - g * g) / (4.0 * kPi * std::pow(1.0 + g * g - 2.0 * g * z, 1.5))};
  };
}

/// What a material of Lightproof draws, seen from the side of `side` times +x.
template <class Surface>
Draw material(const Surface& surface, double degrees, double side = 1.0) {
  const double angle = degrees * kPi / 180.0;
  const ShadingPoint at = {
      {}, frame_around({0.0, 0.0, 1.0}), {side * std::sin(angle), 0.0, std::cos(angle)}};
  return [surface, at](SquarePoint u) {
    const DirectionSample sample = surface.sample(at, u);
    return Drawn{sample.direction, sample.scattering.pdf.value};
  };
}

Ggx ggx(double roughness, MicrofacetSampling sampling = MicrofacetSampling::visible_normals) {
  return {roughness, 1.0, SmithMasking::height_correlated, sampling};
}

test::WrittenDump written(const Draw& draw, std::size_t samples = kSamples) {
  const RandomStream stream("directions", 3);
  return {samples, kColumns, [&](std::size_t i) {
            const auto [d, pdf] = draw(stream.point(i));
            return std::vector<double>{d.x, d.y, d.z, pdf};
          }};
}

GateResult judged(const test::WrittenDump& dump, const std::string& target) {
  const TestCase test_case = direction_test_case(dump.dump(), direction_target(target).value(),
                                                 {"dump", {DensitySpace::solid_angle}});
  return run_gate({&test_case, 1}, spending({}, dump.dump()->count()));
}

std::string rejected_tests(const GateResult& gate) {
  std::string text;
  for (const TestRecord& test : gate.tests) {
    if (test.outcome == Outcome::accept || test.outcome == Outcome::not_run) continue;
    text += fmt::format("{}: {}; ", full_name(test.test), test.detail);
  }
  return text;
}

TEST(DirectionDump, OfEveryTargetIsAcceptedIfItIsRight) {
  const std::vector<std::pair<const char*, Draw>> right = {
      {"uniform", uniform},
      {"uniform-hemisphere", hemisphere},
      {"cosine", cosine},
      {"phong:50", phong(50.0)},
      {"ggx:0.3", material(ggx(0.3), 0.0)},
      {"ggx:0.3@60", material(ggx(0.3), 60.0)},
      {"ggx:0.05@80", material(ggx(0.05), 80.0)},
      {"ggx-normals:0.5@45", material(ggx(0.5, MicrofacetSampling::normals), 45.0)},
      {"ggx-bounded:0.6@80", material(ggx(0.6, MicrofacetSampling::bounded_caps), 80.0)},
      {"blinn:0.3@45", material(BlinnMicrofacet{0.3, 1.0}, 45.0)},
      {"henyey-greenstein:0.7", henyey_greenstein(0.7)},
      {"henyey-greenstein:-0.4", henyey_greenstein(-0.4)}};
  for (const auto& [target, draw] : right) {
    const GateResult gate = judged(written(draw), target);
    EXPECT_EQ(overall_outcome(gate, false), Outcome::accept)
        << target << " " << rejected_tests(gate);
  }
}

struct Mistake {
  const char* target;
  Draw draw;
  const char* looks_like;
};

TEST(DirectionDump, OfAnotherDistributionIsRejectedAndTheOtherOneIsNamed) {
  const Draw polar_angle = [](SquarePoint u) {
    return Drawn{at_height(std::cos(kPi * u.t), u.s), 1.0 / (4.0 * kPi)};
  };
  const std::vector<Mistake> mistakes = {
      {"uniform", polar_angle, "polar-angle-uniform"},
      {"uniform", hemisphere, "hemisphere"},
      {"cosine", hemisphere, "hemisphere"},
      {"phong:50", phong(51.0), "exponent-one-more"},
      {"ggx:0.3@60", material(ggx(std::sqrt(0.3)), 60.0), "roughness-for-alpha"},
      {"henyey-greenstein:0.7", henyey_greenstein(0.49), "g-squared"}};
  for (const Mistake& mistake : mistakes) {
    const GateResult gate = judged(written(mistake.draw), mistake.target);
    EXPECT_EQ(overall_outcome(gate, false), Outcome::reject) << mistake.target;
    ASSERT_EQ(gate.rejections.size(), 1U) << mistake.target;
    EXPECT_EQ(gate.rejections.front().looks_like, mistake.looks_like)
        << mistake.target << " " << gate.rejections.front().confidence;
  }
}

TEST(DirectionDump, InOtherAxesIsRejectedAndTheAxesAreRecognised) {
  const auto turned = [](const Draw& draw, const std::function<Direction(Direction)>& turn) {
    return [=](SquarePoint u) {
      const auto [d, pdf] = draw(u);
      return Drawn{turn(d), pdf};
    };
  };
  const auto upside_down = [](Direction d) { return Direction(d.x, d.y, -d.z); };
  const auto y_up = [](Direction d) { return Direction(d.x, d.z, -d.y); };
  const auto same = [](Direction d) { return d; };
  const std::vector<std::tuple<const char*, Draw, const char*>> mistakes = {
      {"cosine", turned(cosine, upside_down), "--axes=x,y,-z"},
      {"ggx:0.3@60", turned(material(ggx(0.3), 60.0), y_up), "--axes=x,-z,y"},
      {"ggx:0.3@60", turned(material(ggx(0.3), 60.0, -1.0), same), "--axes=-x,-y,z"}};
  for (const auto& [target, draw, options] : mistakes) {
    const test::WrittenDump dump = written(draw);
    EXPECT_EQ(overall_outcome(judged(dump, target), false), Outcome::reject) << options;
    const auto found = recognise(*dump.dump(), direction_target(target).value());
    ASSERT_FALSE(found.empty()) << options;
    EXPECT_EQ(found.front().options, options);
  }
}

TEST(DirectionDump, WithADensityThatIsOffIsRejectedAndAFactorIsRecognised) {
  const Draw twice = [](SquarePoint u) {
    const auto [d, pdf] = cosine(u);
    return Drawn{d, 2.0 * pdf};
  };
  const test::WrittenDump dump = written(twice);
  EXPECT_THAT(rejected_tests(judged(dump, "cosine")), HasSubstr("pdf is the declared density"));
  const auto found = recognise(*dump.dump(), direction_target("cosine").value());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found.front().words, HasSubstr("divided by 2"));
  EXPECT_THAT(recognise(*written(cosine).dump(), direction_target("cosine").value()), IsEmpty());
}

// A microfacet sampler that returns the density of its normals.
TEST(DirectionDump, WithTheDensityOfItsNormalsIsRejected) {
  const Draw right = material(ggx(0.3), 60.0);
  const Direction view = {std::sin(kPi / 3.0), 0.0, 0.5};
  const Draw of_normals = [=](SquarePoint u) {
    const auto [d, pdf] = right(u);
    return Drawn{d, pdf * 2.0 * glm::length(view + d)};
  };
  EXPECT_THAT(rejected_tests(judged(written(of_normals), "ggx:0.3@60")),
              HasSubstr("pdf is the declared density"));
}

TEST(DirectionDump, WithSamplesThatCannotBeDrawnIsRejected) {
  const Draw leaking = [n = 0](SquarePoint u) mutable {
    auto [d, pdf] = cosine(u);
    if (++n % 10'000 == 0) d.z = -d.z;
    return Drawn{d, pdf};
  };
  const GateResult gate = judged(written(leaking), "cosine");
  EXPECT_THAT(rejected_tests(gate), HasSubstr("no zero-density samples"));
}

TEST(DirectionDump, OfFewSamplesIsInconclusive) {
  EXPECT_EQ(overall_outcome(judged(written(cosine, 500), "cosine"), false), Outcome::inconclusive);
}

TEST(DirectionTarget, IsRefusedByNameIfItsParametersMakeNoSense) {
  const auto refused = [](const char* text, const char* reason) {
    EXPECT_THAT([&] { direction_target(text); },
                testing::ThrowsMessage<InputError>(HasSubstr(reason)))
        << text;
  };
  refused("phong", "parameter is missing");
  refused("phong:x", "is no number from 0 to 1000000");
  refused("phong:nan", "is no number");
  refused("ggx:0", "is no number from 0.01 to 1");
  refused("ggx:0.3@90", "is no number from 0 to 89.9");
  refused("cosine:2", "has no parameter");
  refused("cosine@30", "depends on no view");
  refused("henyey-greenstein:1", "from -0.99 to 0.99");
  EXPECT_FALSE(direction_target("studio.exr").has_value());
}

}  // namespace
}  // namespace lightproof
