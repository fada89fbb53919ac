// What is charted of every estimator: errors as the exact moments have them, whatever computes
// them.
#include "lightproof/accuracy/measurement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "lightproof/accuracy/exact_light.h"
#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {

using ::testing::HasSubstr;

constexpr AccuracyQuality kSmall = {"draft", 256, 3, 12};

AccuracyScene scene(const char* receiver, const char* material) {
  return {&receiver_by_name(receiver), {material, material_of(material)}};
}

AccuracyChart chart_of(const EnvironmentMap& map, const AccuracyScene& scene,
                       AccuracyOptions options = {.quality = kSmall}) {
  return measure_accuracy(map, {&scene, 1}, options).front();
}

const AccuracyLine& line_of(const AccuracyChart& chart, std::string_view estimator) {
  for (const AccuracyLine& line : chart.lines) {
    if (line.estimator == estimator) return line;
  }
  throw std::out_of_range(std::string(estimator));
}

class AccuracyOf : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

// The mean square error of many estimates is nearly normal where its relative error is below a
// tenth. There are some 300 comparisons: one of them exceeds five standard errors with probability
// 2e-4 or so.
TEST_P(AccuracyOf, ErrorsAreThoseOfTheExactMoments) {
  const auto [receiver, material] = GetParam();
  const AccuracyChart chart = chart_of(make_synthetic_map("sun-sky", {64, 32}),
                                       scene(receiver, material), {.quality = {"", 64, 12, 12}});
  int compared = 0;
  for (const AccuracyLine& line : chart.lines) {
    for (const AccuracyPoint& point : line.points) {
      if (!(point.predicted > 0.0) || point.rmse_error > 0.05 * point.rmse) continue;
      ++compared;
      const double expected = point.predicted * point.predicted;
      const double error =
          2.0 * point.rmse * point.rmse_error * expected / (point.rmse * point.rmse);
      EXPECT_NEAR(point.rmse * point.rmse, expected, 5.0 * error)
          << line.estimator << " at " << point.samples;
    }
  }
  EXPECT_GE(compared, 15);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, AccuracyOf,
    testing::Values(std::tuple("sphere", "lambert"), std::tuple("sphere", "ggx:0.5"),
                    std::tuple("sphere-on-plane", "phong:20")),
    [](const auto& values) {
      std::string name = std::string(std::get<0>(values.param)) + "_" + std::get<1>(values.param);
      std::replace_if(
          name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
      return name;
    });

TEST(Accuracy, ShowsEveryEstimatorOrSaysWhyNot) {
  const AccuracyChart chart =
      chart_of(make_synthetic_map("gradient", {32, 16}), scene("sphere", "ggx:0.3"));
  std::set<std::string> names;
  for (const AccuracyLine& line : chart.lines) {
    names.insert(line.estimator);
    EXPECT_FALSE(line.points.empty()) << line.estimator;
    for (const AccuracyPoint& point : line.points) {
      EXPECT_GT(point.seconds, 0.0) << line.estimator;
      EXPECT_TRUE(std::isfinite(point.rmse)) << line.estimator;
    }
  }
  EXPECT_GE(names.size(), 25U);
  for (const LeftOutEstimator& out : chart.left_out) {
    EXPECT_FALSE(out.reason.empty());
    names.insert(out.estimator);
  }
  EXPECT_EQ(names.size(), estimators().size());
}

TEST(Accuracy, ErrorsAreTheSameForAnyNumberOfThreads) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {32, 16});
  const auto errors = [&] {
    std::vector<double> all;
    for (const AccuracyLine& line : chart_of(map, scene("sphere", "phong:20")).lines) {
      for (const AccuracyPoint& point : line.points) {
        all.insert(all.end(), {point.rmse, point.rmse_error});
      }
      all.push_back(line.floor);
    }
    return all;
  };
  const std::vector<double> many = errors();
  const ThreadLimit one(1);
  EXPECT_EQ(many, errors());
}

TEST(Accuracy, OfATabulatedProductIsExactWhereNothingIsInTheWay) {
  const EnvironmentMap map = make_synthetic_map("constant", {256, 128});
  const auto is_product = [](const EstimatorInfo& info) { return info.name == "product table"; };
  const AccuracyOptions options = {.quality = kSmall, .select = is_product};
  const double open = line_of(chart_of(map, scene("sphere", "lambert"), options), "product table")
                          .points.front()
                          .rmse;
  // What a cosine varies by within a texel of h = pi/128: of the gradient sin(theta) the variance
  // is h^2/12 sin^2(theta), over cos(theta), over the hemisphere about h^2/6 ln(1/h), which is
  // 0.019^2.
  EXPECT_LT(open, 0.02);
  const double blocked =
      line_of(chart_of(map, scene("sphere-on-plane", "lambert"), options), "product table")
          .points.front()
          .rmse;
  EXPECT_GT(blocked, 5.0 * open);
}

TEST(Accuracy, OfABiasedEstimatorStopsAtItsFloor) {
  const EnvironmentMap map = make_synthetic_map("one-texel", {64, 32});
  const auto chart = chart_of(map, scene("sphere", "lambert"));
  const AccuracyLine& harmonics = line_of(chart, "sh-9");
  ASSERT_EQ(harmonics.points.size(), 1U);
  EXPECT_TRUE(harmonics.is_biased);
  EXPECT_GT(harmonics.floor, 0.02);
  EXPECT_NEAR(harmonics.floor, harmonics.points[0].rmse, 1e-12);
  EXPECT_EQ(line_of(chart, "environment B").floor, 0.0);
}

// A map without a sun: 256 directions in even steps do not find one texel yet.
TEST(Accuracy, HasNoFloorWhereTheBiasVanishesWithMoreSamples) {
  const EnvironmentMap map = make_synthetic_map("gradient", {64, 32});
  const auto is_one = [](const EstimatorInfo& info) { return info.bias_vanishes; };
  const AccuracyChart chart =
      chart_of(map, scene("sphere", "ggx:0.3"), {.quality = kSmall, .select = is_one});
  ASSERT_EQ(chart.lines.size(), 2U);
  for (const AccuracyLine& line : chart.lines) {
    EXPECT_TRUE(line.is_biased) << line.estimator;
    EXPECT_EQ(line.floor, 0.0) << line.estimator;
    EXPECT_LT(line.points.back().rmse, 0.2 * line.points.front().rmse) << line.estimator;
  }
}

TEST(Accuracy, OfWhatIgnoresOcclusionIsBiasedWhereLightIsBlocked) {
  const EnvironmentMap map = make_synthetic_map("constant", {64, 32});
  const auto is_table = [](const EstimatorInfo& info) { return info.name == "sh-9"; };
  const AccuracyOptions options = {.quality = kSmall, .select = is_table};
  EXPECT_LT(line_of(chart_of(map, scene("sphere", "lambert"), options), "sh-9").floor, 1e-6);
  EXPECT_GT(line_of(chart_of(map, scene("sphere-on-plane", "lambert"), options), "sh-9").floor,
            0.05);
}

TEST(Accuracy, OfDifferentSeedsDiffers) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {32, 16});
  const auto rmse = [&](std::uint64_t seed) {
    return line_of(chart_of(map, scene("sphere", "lambert"), {.quality = kSmall, .seed = seed}),
                   "environment B")
        .points.front()
        .rmse;
  };
  EXPECT_NE(rmse(1), rmse(2));
}

// Random points fall by the square root of their number. Sobol's do better where a monotone table
// keeps their strata: the integrand of a diffuse sphere is smooth but for its horizon.
TEST(Accuracy, FallsWithTheSlopeOfItsPoints) {
  const auto chosen = [](const EstimatorInfo& info) {
    return info.name == "environment B" || info.name == "environment B sobol";
  };
  const AccuracyChart chart =
      chart_of(make_synthetic_map("gradient", {64, 32}), scene("sphere", "lambert"),
               {.quality = {"", 1024, 16, 12}, .select = chosen});
  const AccuracyLine& random = line_of(chart, "environment B");
  EXPECT_NEAR(random.slope, -0.5, 5.0 * random.slope_error);
  EXPECT_LT(random.slope_error, 0.02);
  const AccuracyLine& sobol = line_of(chart, "environment B sobol");
  EXPECT_LT(sobol.slope + 5.0 * sobol.slope_error, random.slope);
}

// The slope is fitted to points that know nothing of each other.
TEST(Accuracy, OfEachNumberOfSamplesHasRandomNumbersOfItsOwn) {
  const auto is_uniform = [](const EstimatorInfo& info) { return info.name == "uniform"; };
  const AccuracyChart chart =
      chart_of(make_synthetic_map("gradient", {32, 16}), scene("sphere", "lambert"),
               {.quality = kSmall, .select = is_uniform, .samples = [](const EstimatorInfo&) {
                  return std::vector<std::uint64_t>{16, 16};
                }});
  const std::vector<AccuracyPoint>& points = line_of(chart, "uniform").points;
  EXPECT_GT(std::abs(points[0].rmse / points[1].rmse - 1.0), 1e-6);
}

TEST(Accuracy, OfRoundsDiffersFromRoundToRound) {
  const auto is_uniform = [](const EstimatorInfo& info) { return info.name == "uniform"; };
  const auto rmse = [&](int rounds) {
    return line_of(chart_of(make_synthetic_map("gradient", {32, 16}), scene("sphere", "lambert"),
                            {.quality = {"", 1, rounds, 12}, .select = is_uniform}),
                   "uniform")
        .points.front()
        .rmse;
  };
  EXPECT_GT(std::abs(rmse(3) / rmse(6) - 1.0), 1e-6);
}

TEST(Accuracy, RefusesAReceiverThatNoLightReaches) {
  EnvironmentMap map = make_synthetic_map("constant", {32, 16});
  for (Rgb& texel : map.radiance.values()) texel = Rgb(0.0F);
  map.name = "night";
  try {
    chart_of(map, scene("sphere", "lambert"));
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("night"));
  }
}

// A lobe of a hundredth of a radian in cells of a fortieth: what is reflected of a constant sky is
// the material's albedo, whatever the map's size. GGX seen at 83 degrees, by 4096 x 2048 cells:
// .9491 of the light, and by 200,000 samples .9492.
TEST(ExactLight, OfANarrowLobeIsTheSameOnSmallMaps) {
  const ReceiverInfo& point = receiver_by_name("point");
  const Scene scene(point.content);
  Pixel pixel = visible_pixels(point, scene, {4, 3}).front();
  const double cosine = 0.116;
  pixel.point.view = {std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
  std::vector<double> means;
  for (const Extent extent : {Extent{64, 32}, Extent{320, 160}, Extent{2048, 1024}}) {
    const Grid<double> sky(extent, 1.0);
    const auto light = exact_light({&sky, 1}, point, scene, material_of("ggx:0.1"), {&pixel, 1});
    means.push_back(light[0][0][reference::SampledDensity::uniform].mean());
  }
  EXPECT_NEAR(means[0] / means[2], 1.0, 2e-4);
  EXPECT_NEAR(means[1] / means[2], 1.0, 2e-4);
  EXPECT_NEAR(means[2], 0.949, 1e-3);
}

TEST(AccuracyQualities, AnswerAnUnknownNameWithTheKnownOnes) {
  EXPECT_EQ(accuracy_quality_by_name("default").most_samples, 65536U);
  try {
    accuracy_quality_by_name("perfect");
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("draft, default, paper"));
  }
}

}  // namespace
}  // namespace lightproof
