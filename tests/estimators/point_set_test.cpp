// Estimators whose samples depend on each other: unbiased against quadrature, and better than as
// many independent samples.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/accuracy/exact_light.h"
#include "lightproof/core/error.h"
#include "lightproof/core/moments.h"
#include "lightproof/core/parallel.h"
#include "lightproof/estimators/point_set.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/render/receiver.h"
#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

using reference::SampledDensity;

/// The first and the last pixel of a receiver at which light is gathered, and their exact moments.
struct Stage {
  Stage(std::string_view map_name, std::string_view receiver_name, const MaterialInfo& with)
      : map(make_synthetic_map(map_name, {64, 32})),
        receiver(receiver_by_name(receiver_name)),
        scene(receiver.content),
        material(with) {
    const auto all = visible_pixels(receiver, scene, {3, 2});
    pixels = {all.front(), all.back()};
    const Grid<double> luminance = luminance_of(map);
    exact = exact_light({&luminance, 1}, receiver, scene, material.material, pixels)[0];
  }

  BoundEstimator bound(const EstimatorInfo& info) const {
    return info.prepare(map).bind(scene, material.material);
  }

  EnvironmentMap map;
  const ReceiverInfo& receiver;
  Scene scene;
  const MaterialInfo& material;
  std::vector<Pixel> pixels;
  std::vector<reference::LightMoments> exact;
};

/// Luminances of independent estimates of so many samples each.
Moments estimates(const BoundEstimator& estimator, const ShadingPoint& at,
                  const RandomStream& stream, std::uint64_t samples, std::size_t count) {
  std::vector<double> luminances(count);
  parallel_for(count, [&](std::size_t i) {
    luminances[i] = luminance_of(estimator.integrate(at, stream, {i * samples, samples}, {}));
  });
  Moments moments;
  moments.add(luminances);
  return moments;
}

std::vector<EstimatorInfo> point_set_estimators() {
  std::vector<EstimatorInfo> rows;
  for (const EstimatorInfo& info : estimators()) {
    if (info.kind == EstimatorKind::point_set) rows.push_back(info);
  }
  return rows;
}

/// Those over one density with known moments, by a monotone table where they draw from the map.
std::vector<EstimatorInfo> monotone_estimators() {
  std::vector<EstimatorInfo> rows;
  for (const EstimatorInfo& info : point_set_estimators()) {
    const bool is_alias = info.name.starts_with("environment B alias");
    if ((info.name.starts_with("environment B") && !is_alias) || info.name.starts_with("brdf")) {
      rows.push_back(info);
    }
  }
  return rows;
}

class PointSetEstimators : public testing::TestWithParam<std::string_view> {};

// 3 maps, 5 materials, 8 estimators, 2 pixels: together they reject right estimators with
// probability 1e-7, which the skewness of the estimates (below 3, over 8192 of them) raises tenfold
// at most. 24 samples are no power of two.
TEST_P(PointSetEstimators, AreUnbiased) {
  constexpr std::size_t kEstimates = 8192;
  const double log10_level = std::log10(1e-7 / (3 * 5 * 8 * 2));
  for (const MaterialInfo& material : materials()) {
    const Stage stage(GetParam(), "sphere", material);
    for (const EstimatorInfo& info : monotone_estimators()) {
      const BoundEstimator estimator = stage.bound(info);
      for (std::size_t i = 0; i < stage.pixels.size(); ++i) {
        const std::string name =
            fmt::format("{}/{}/{}/{}", GetParam(), material.name, info.name, i);
        const Moments measured = estimates(estimator, stage.pixels[i].point,
                                           RandomStream("unbiased/" + name, 1), 24, kEstimates);
        const double exact = stage.exact[i][SampledDensity::uniform].mean();
        // Float radiance and weights: a few roundings, where there is no other scatter.
        const double error = measured.standard_error() + 1e-7 * exact;
        const double z = (measured.mean() - exact) / error;
        EXPECT_GT(log10_normal_tails(z), log10_level) << name << ": z = " << z;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, PointSetEstimators,
                         testing::Values("constant", "gradient", "checker"));

// Half of the variance of as many independent samples at the most, whatever the edges; where what
// is drawn from is not what is integrated. Of 1024 estimates the variance is off by less than a
// third in six standard errors, as long as the kurtosis is below 4.
TEST(PointSetEstimates, ScatterLessThanIndependentSamples) {
  constexpr std::uint64_t kSamples = 256;
  for (const MaterialInfo& material : materials()) {
    const Stage stage("gradient", "sphere", material);
    for (const EstimatorInfo& info : monotone_estimators()) {
      const bool is_map = info.name.starts_with("environment");
      const auto density = is_map ? SampledDensity::solid_angle : SampledDensity::material;
      for (std::size_t i = 0; i < stage.pixels.size(); ++i) {
        const Moments measured =
            estimates(stage.bound(info), stage.pixels[i].point,
                      RandomStream(fmt::format("scatter/{}/{}", info.name, i), 1), kSamples, 1024);
        const double independent =
            stage.exact[i][density].variance() / static_cast<double>(kSamples);
        // One random point in each cell never scatters more than as many independent ones, and has
        // no more than that in common with lattices and nets.
        const double factor = info.name.ends_with("stratified") ? 1.0 : 0.5;
        EXPECT_LT(measured.variance(), factor * independent) << info.name << ", " << material.name;
      }
    }
  }
}

// An alias table sends neighbouring points to unrelated texels: points that are more even than
// random ones lose nearly all that they gain. By a monotone table they keep it: less than half of
// the variance is left of what the alias table leaves. Errors of variances as above.
TEST(PointSetEstimates, LoseTheirEvennessInAnAliasTable) {
  constexpr std::uint64_t kSamples = 256;
  const Stage stage("gradient", "sphere", material_by_name("lambert"));
  for (const std::string_view set : {"stratified", "hammersley", "R2", "sobol"}) {
    for (std::size_t i = 0; i < stage.pixels.size(); ++i) {
      const auto variance = [&](std::string_view table) {
        const std::string name = fmt::format("{} {}", table, set);
        return estimates(stage.bound(estimator_by_name(name)), stage.pixels[i].point,
                         RandomStream(fmt::format("evenness/{}/{}", name, i), 1), kSamples, 1024)
            .variance();
      };
      EXPECT_LT(variance("environment B"), 0.5 * variance("environment B alias")) << set;
    }
  }
}

TEST(PointSetEstimates, DependOnStreamAndBudgetAlone) {
  const Stage stage("sun-sky", "sphere", material_by_name("phong"));
  const ShadingPoint& at = stage.pixels.front().point;
  const RandomStream stream("alone", 1);
  const EachEstimate never = [](std::span<const Rgb>) { FAIL() << "no mean of independent ones"; };
  for (const EstimatorInfo& info : point_set_estimators()) {
    const BoundEstimator estimator = stage.bound(info);
    const Rgb once = estimator.integrate(at, stream, {0, 300}, never);
    EXPECT_EQ(stage.bound(info).integrate(at, stream, {0, 300}, {}), once) << info.name;
    EXPECT_NE(estimator.integrate(at, stream, {300, 300}, {}), once) << info.name;
    EXPECT_NE(estimator.integrate(at, stream.substream(1), {0, 300}, {}), once) << info.name;
  }
}

// A constant map and cosine lobes: every sample is the albedo times the radiance, and so is the
// mean over as many as there are, however they divide into batches. Float radiance and weights.
TEST(PointSetEstimates, AreTheMeanOfTheirBudget) {
  const Stage stage("constant", "plane", material_by_name("lambert"));
  const double exact = stage.exact[0][SampledDensity::uniform].mean();
  for (const std::uint64_t samples : {1U, 255U, 256U, 257U, 1000U}) {
    const BoundEstimator estimator = stage.bound(estimator_by_name("brdf sobol"));
    const double luminance = luminance_of(
        estimator.integrate(stage.pixels[0].point, RandomStream("mean", 1), {0, samples}, {}));
    EXPECT_NEAR(luminance / exact, 1.0, 1e-6) << samples;
  }
}

TEST(PointSetEstimates, NeedAPointSetThatThereIs) {
  const EnvironmentMap map = make_synthetic_map("constant", {4, 2});
  EXPECT_THROW(prepare_point_set(map, UniformSphere{}, "halton"), InputError);
}

}  // namespace
}  // namespace lightproof
