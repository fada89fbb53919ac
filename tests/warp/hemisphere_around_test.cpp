// Every way to draw around a normal has one law: two-sample tests between them, and the law itself.
#include "lightproof/warp/hemisphere_around.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/core/random.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

using Draw = Direction (*)(Direction normal, SquarePoint u);

struct Named {
  const char* name;
  Draw draw;
};
constexpr std::array<Named, 3> kCosines = {{
    {"cosine by frame_around", cosine_hemisphere_around},
    {"cosine by tangent frame", cosine_hemisphere_by_tangent_frame},
    {"cosine by quaternion", cosine_hemisphere_by_quaternion},
}};
constexpr std::array<Named, 3> kUniforms = {{
    {"uniform by frame_around", uniform_hemisphere_around},
    {"uniform by tangent frame", uniform_hemisphere_by_tangent_frame},
    {"uniform by quaternion", uniform_hemisphere_by_quaternion},
}};

/// The poles, next to the nadir, on the horizon, oblique.
std::vector<Direction> normals() {
  return {{0, 0, 1},
          {0, 0, -1},
          glm::normalize(Direction(1e-9, -2e-9, -1)),
          {0.6, 0.8, 0},
          glm::normalize(Direction(0.3, -0.5, 0.4)),
          glm::normalize(Direction(-0.2, 0.6, -0.7))};
}

constexpr std::uint64_t kSamples = 1U << 19U;
constexpr Extent kBins = {32, 16};
/// The error probability of this file, shared out among its tests of hypotheses: three pairs and
/// three laws for each of six normals and two warps.
const double kLog10Level = std::log10(1e-6 / (6 * 6 * 2));

int cell_of(double share, int cells) {
  return std::clamp(static_cast<int>(share * cells), 0, cells - 1);
}

Grid<std::uint64_t> counted(Draw draw, Direction n, const std::string& stream_name) {
  const RandomStream stream(stream_name, 1);
  Grid<std::uint64_t> counts(kBins);
  for (std::uint64_t i = 0; i < kSamples; ++i) {
    const SquarePoint at = square_from_direction(draw(n, stream.point(i)));
    ++counts(cell_of(at.s, kBins.width), cell_of(at.t, kBins.height));
  }
  return counts;
}

double log10_p_of_two(Draw a, Draw b, Direction n, const std::string& what) {
  const GoodnessOfFit fit = two_sample_fit(serpentine(counted(a, n, "first of " + what)),
                                           serpentine(counted(b, n, "second of " + what)));
  EXPECT_GT(fit.dof, 100.0);
  return fit.log10_p;
}

void expect_one_distribution(const std::array<Named, 3>& ways) {
  int index = 0;
  for (const Direction n : normals()) {
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const Named& a = ways[i];
      const Named& b = ways[(i + 1) % ways.size()];
      const std::string what = std::string(a.name) + " and " + b.name + std::to_string(index);
      EXPECT_GT(log10_p_of_two(a.draw, b.draw, n, what), kLog10Level) << what;
    }
    ++index;
  }
}

TEST(CosineHemisphere, HasOneDistributionWhateverTheFrame) { expect_one_distribution(kCosines); }
TEST(UniformHemisphere, HasOneDistributionWhateverTheFrame) { expect_one_distribution(kUniforms); }

TEST(CosineHemisphere, HasOtherSamplesWithAnotherFrame) {
  const Direction n = normals().back();
  for (const SquarePoint u : {SquarePoint{0.1, 0.5}, SquarePoint{0.7, 0.2}}) {
    const Direction a = cosine_hemisphere_by_tangent_frame(n, u);
    const Direction b = cosine_hemisphere_by_quaternion(n, u);
    EXPECT_GT(glm::distance(a, b), 0.01);
    EXPECT_NEAR(glm::dot(a, n), glm::dot(b, n), 1e-15);
  }
}

/// The rotation around (n.y, -n.x, 0): the other way.
Direction cosine_turned_the_other_way(Direction n, SquarePoint u) {
  return cosine_hemisphere_by_quaternion({-n.x, -n.y, n.z}, u);
}

TEST(TwoSamples, TellApartWhatHasAnotherLaw) {
  const Direction n = normals().back();
  for (const Draw wrong : {cosine_turned_the_other_way, uniform_hemisphere_around}) {
    EXPECT_LT(log10_p_of_two(cosine_hemisphere_by_quaternion, wrong, n, "wrong"), -100.0);
  }
}

/// Counts of (height, azimuth) around n, each uniform in [0,1) if `height` is the distribution
/// function of the cosine. The azimuth is that of a frame of this test's own.
template <class Height>
GoodnessOfFit fit_around(Draw draw, Direction n, const Height& height, const std::string& name) {
  const Direction aside = std::abs(n.x) < 0.5 ? Direction(1, 0, 0) : Direction(0, 1, 0);
  const Direction x = glm::normalize(aside - glm::dot(aside, n) * n);
  const Direction y = glm::cross(n, x);
  const RandomStream stream(name, 1);
  Grid<std::uint64_t> counts({16, 64});
  for (std::uint64_t i = 0; i < kSamples; ++i) {
    const Direction d = draw(n, stream.point(i));
    const double azimuth = std::atan2(glm::dot(d, y), glm::dot(d, x)) / (2.0 * kPi);
    ++counts(cell_of(azimuth < 0.0 ? azimuth + 1.0 : azimuth, 16),
             cell_of(height(glm::dot(d, n)), 64));
  }
  const std::vector<double> even(counts.extent().count(),
                                 1.0 / static_cast<double>(counts.extent().count()));
  return cressie_read(serpentine(counts), even, kSamples);
}

double square(double cosine) { return cosine * cosine; }
double itself(double cosine) { return cosine; }

template <class Height>
void expect_distribution(const std::array<Named, 3>& ways, const Height& height) {
  int index = 0;
  for (const Direction n : normals()) {
    for (const Named& way : ways) {
      const std::string name = std::string(way.name) + std::to_string(index);
      EXPECT_GT(fit_around(way.draw, n, height, name).log10_p, kLog10Level) << name;
    }
    ++index;
  }
}

TEST(CosineHemisphere, HasUniformSquaresOfTheCosineAndUniformAzimuths) {
  expect_distribution(kCosines, square);
}
TEST(UniformHemisphere, HasUniformCosinesAndUniformAzimuths) {
  expect_distribution(kUniforms, itself);
}

TEST(HemispheresAround, DoNotPassForEachOther) {
  const Direction n = normals()[0];
  EXPECT_LT(fit_around(uniform_hemisphere_around, n, square, "a wrong law").log10_p, -100.0);
  EXPECT_LT(fit_around(cosine_hemisphere_around, n, itself, "a wrong law").log10_p, -100.0);
}

// A ten-millionth of a radian from the nadir the published matrix divides by 1 + n.z, of which
// rounding leaves one digit or none: its directions are no unit vectors. At the nadir itself, which
// it treats apart, and above the horizon they are.
TEST(PublishedQuaternion, GivesNoUnitVectorsNextToTheNadir) {
  const Direction next = glm::normalize(Direction(7e-8, 7e-8, -1));
  double published = 0.0;
  for (const SquarePoint u :
       {SquarePoint{0.1, 0.5}, SquarePoint{0.4, 0.9}, SquarePoint{0.8, 0.7}}) {
    const auto error = [&](Draw draw, Direction n) {
      return std::abs(glm::length(draw(n, u)) - 1.0);
    };
    published = std::max(published, error(published_cosine_hemisphere_by_quaternion, next));
    EXPECT_LE(error(cosine_hemisphere_by_quaternion, next), 2e-15);
    for (const Direction n : {normals()[0], normals()[1], normals()[4]}) {
      EXPECT_LE(error(published_cosine_hemisphere_by_quaternion, n), 2e-15);
    }
  }
  EXPECT_GT(published, 1e-3);
}

}  // namespace
}  // namespace lightproof
