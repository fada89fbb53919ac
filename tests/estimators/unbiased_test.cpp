// Every estimator that claims to be unbiased, on three maps, three materials and all receivers,
// against quadrature; and variances against exact ones where they are known.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "lightproof/accuracy/exact_light.h"
#include "lightproof/core/error.h"
#include "lightproof/core/moments.h"
#include "lightproof/core/parallel.h"
#include "lightproof/estimators/environment.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/render/receiver.h"
#include "lightproof/stats/moment_tests.h"
#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

using reference::MeanAndVariance;

/// Maps of one size, a receiver and a material, and the first and the last pixel at which light is
/// gathered.
struct Stage {
  Stage(std::span<const std::string_view> map_names, std::string_view receiver_name,
        const Material& with, Extent extent = {64, 32})
      : receiver(receiver_by_name(receiver_name)),
        scene(receiver.content),
        material(with),
        pixels(visible_pixels(receiver, scene, {3, 2})) {
    for (const std::string_view name : map_names) {
      maps.push_back(make_synthetic_map(name, extent));
      luminances.push_back(luminance_of(maps.back()));
    }
    if (pixels.size() > 2) pixels = {pixels.front(), pixels.back()};
  }
  Stage(std::string_view map_name, std::string_view receiver_name, const Material& with,
        Extent extent = {64, 32})
      : Stage(std::span(&map_name, 1), receiver_name, with, extent) {}

  reference::Kernel kernel(std::size_t pixel, const Material& of) const {
    return kernel_at(receiver, scene, of, pixels[pixel].point);
  }
  /// Of the first map.
  BoundEstimator bound(const EstimatorInfo& info) const {
    return info.prepare(maps.front()).bind(scene, material);
  }

  std::vector<EnvironmentMap> maps;
  std::vector<Grid<double>> luminances;
  const ReceiverInfo& receiver;
  Scene scene;
  Material material;
  std::vector<Pixel> pixels;
};

/// The material with GGX's normals drawn in the way that an estimator's name says; of other
/// estimators none.
std::optional<Material> drawn_by_name(const Stage& stage, std::string_view name) {
  if (!name.starts_with("ggx ")) return std::nullopt;
  Ggx ggx = std::get<Ggx>(stage.material);
  name.remove_prefix(4);
  ggx.sampling = name == "normals"           ? MicrofacetSampling::normals
                 : name == "visible normals" ? MicrofacetSampling::visible_normals
                 : name == "spherical caps"  ? MicrofacetSampling::spherical_caps
                                             : MicrofacetSampling::bounded_caps;
  return ggx;
}

/// Mean, variance of one sample, and the largest single estimate, of one estimator on every map.
using ExactMoments = std::vector<MeanAndVariance>;

ExactMoments of_density(std::span<const reference::LightMoments> moments,
                        reference::SampledDensity density) {
  ExactMoments all;
  for (const reference::LightMoments& each : moments) {
    all.push_back({each[density].mean(), each[density].variance(), each[density].largest});
  }
  return all;
}

/// What is exact at one pixel.
struct Exact {
  std::vector<reference::LightMoments> light;             ///< of every map
  std::map<std::string_view, ExactMoments> of_estimator;  ///< of those whose moments are known

  Exact(const Stage& stage, std::size_t pixel)
      : light(reference::light_moments(stage.kernel(pixel, stage.material), stage.luminances)) {
    std::vector<std::string_view> combined;
    std::vector<reference::CombinedSampling> samplings;
    for (const EstimatorInfo& info : estimators()) {
      if (!info.serves(stage.material)) continue;
      if (info.density) of_estimator[info.name] = of_density(light, *info.density);
      if (const auto drawn = drawn_by_name(stage, info.name)) {
        of_estimator[info.name] =
            of_density(reference::light_moments(stage.kernel(pixel, *drawn), stage.luminances),
                       reference::SampledDensity::material);
      }
      if (!info.combined) continue;
      combined.push_back(info.name);
      samplings.push_back(*info.combined);
    }
    const reference::Kernel kernel = stage.kernel(pixel, stage.material);
    const Direction normal = stage.pixels[pixel].point.frame.normal;
    const std::array<reference::DensityAtNode, 2> densities = {
        [](const reference::Node& /*node*/) { return 0.5 / kPi; },
        [normal](const reference::Node& node) { return glm::dot(normal, node.direction) / kPi; }};
    const auto moments = reference::sampling_moments(kernel, stage.luminances, samplings, densities,
                                                     reference::CellRule::gauss);
    for (std::size_t i = 0; i < combined.size(); ++i) {
      of_estimator[combined[i]] = moments.combined[i];
    }
    of_estimator["hemisphere"] = moments.densities[0];
    of_estimator["cosine"] = moments.densities[1];
  }

  std::optional<MeanAndVariance> known(std::string_view estimator, std::size_t map) const {
    const auto found = of_estimator.find(estimator);
    if (found == of_estimator.end()) return std::nullopt;
    return found->second[map];
  }
};

/// Luminances of estimates of so many samples each.
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

class Unbiased : public testing::TestWithParam<std::string_view> {};

/// Of all tests of this file together: right estimators are rejected with this probability.
constexpr double kFamilyAlpha = 1e-6;
/// 3 maps, 3 materials, 7 pixels of 4 receivers, fewer than 64 estimators.
constexpr double kTests = 3.0 * 3.0 * 7.0 * 64.0;
constexpr std::uint64_t kSamples = 32;
constexpr std::size_t kEstimates = 1024;

/// Quadrature's error along the silhouettes of what is in the way, relative to the light: cells of
/// pi/2048 that are half in the dark, 2000 of them along an edge, each wrong by half of itself at
/// the most with a sign of its own: sqrt(2000) 1.2e-6 sr against a hemisphere's pi.
constexpr double kSilhouette = 2e-5;

/// log10 of a two-sided p-value of the mean of so many independent estimates, by Bennett's bound
/// where normal tails do not hold.
double log10_bounded(double beyond, double estimates, const MeanAndVariance& moments) {
  return log10_tails_of_mean(beyond / std::sqrt(moments.variance / estimates), estimates,
                             {moments.mean, moments.variance, 2.0 * 1.1 * moments.largest});
}

/// log10 of a two-sided p-value by the measured scatter. A skewness of the estimates of up to 1.5
/// makes the p-value of right estimators up to exp(1.5 z^3 / 3 sqrt(1024)), a thousand times
/// smaller at z = 7.6, for which the level below is a thousandth.
double log10_by_scatter(double off, const Moments& measured, double rounding) {
  return log10_normal_tails(off / (measured.standard_error() + rounding)) + 3.0;
}

/// The density of single samples of estimators whose samples depend on each other; none of others.
std::optional<reference::SampledDensity> density_of_points(const EstimatorInfo& info) {
  if (info.kind != EstimatorKind::point_set) return std::nullopt;
  if (info.name.starts_with("environment B")) return reference::SampledDensity::solid_angle;
  if (info.name.starts_with("brdf")) return reference::SampledDensity::material;
  return std::nullopt;
}

/// Whether a mean of kSamples independent samples is as little skewed as log10_by_scatter() allows
/// for. Where a rare direction brings much of the light, most runs miss it, and their scatter says
/// nothing of it.
bool has_normal_tails(const reference::EstimatorMoments& moments) {
  const double m = moments.mean();
  const double third = moments.raw[2] - 3.0 * m * moments.raw[1] + 2.0 * m * m * m;
  const double skewness = third / std::pow(std::max(moments.variance(), 1e-300), 1.5);
  return moments.variance() < 1e-9 * m * m ||
         skewness / std::sqrt(static_cast<double>(kSamples)) < 1.5;
}

/// log10 of a two-sided p-value of the mean of kEstimates estimates of kSamples samples each. Where
/// the scatter cannot be trusted, samples that depend on each other are taken for one and the same:
/// their mean has no larger variance than one of them, and is no larger than the largest.
double log10_p(const Moments& measured, const EstimatorInfo& info,
               const std::optional<MeanAndVariance>& known, const reference::LightMoments& light,
               double mean, double rounding) {
  const double off = std::abs(measured.mean() - mean);
  const double beyond = std::max(0.0, off - rounding);
  constexpr auto kCount = static_cast<double>(kEstimates);
  if (known && known->variance > 0.0) return log10_bounded(beyond, kCount * kSamples, *known);
  if (known) return log10_normal_tails(off / (measured.standard_error() + rounding));
  const auto density = density_of_points(info);
  if (!density || has_normal_tails(light[*density])) {
    return log10_by_scatter(off, measured, rounding);
  }
  const reference::EstimatorMoments& single = light[*density];
  return log10_bounded(beyond, kCount, {single.mean(), single.variance(), single.largest});
}

constexpr std::string_view kMaps[] = {"constant", "gradient", "sun-sky"};

TEST_P(Unbiased, EstimatesAgreeWithQuadrature) {
  const double log10_level = std::log10(kFamilyAlpha / kTests);
  for (const std::string_view name : {"lambert", "phong", "ggx"}) {
    const Stage stage(kMaps, GetParam(), material_by_name(name).material);
    for (std::size_t i = 0; i < stage.pixels.size(); ++i) {
      const Exact exact(stage, i);
      for (const EstimatorInfo& info : estimators()) {
        if (info.is_biased || !info.serves(stage.material)) continue;
        for (std::size_t map = 0; map < stage.maps.size(); ++map) {
          const auto known = exact.known(info.name, map);
          const double mean = exact.light[map][reference::SampledDensity::uniform].mean();
          // Float radiance and weights: a few roundings; positions found to 2e-8 of the map's
          // width.
          const double rounding = mean * (1e-6 + (stage.receiver.occluded ? kSilhouette : 0.0));
          const std::string label =
              fmt::format("{}/{}/{}/{}/{}", kMaps[map], GetParam(), name, info.name, i);
          const BoundEstimator bound =
              info.prepare(stage.maps[map]).bind(stage.scene, stage.material);
          const Moments measured =
              estimates(bound, stage.pixels[i].point, RandomStream("quadrature/" + label, 1),
                        kSamples, kEstimates);
          EXPECT_GT(log10_p(measured, info, known, exact.light[map], mean, rounding), log10_level)
              << label << ": " << measured.mean() << " for " << mean << ", standard error "
              << measured.standard_error();
        }
      }
    }
  }
}

std::vector<std::string_view> receiver_names() {
  std::vector<std::string_view> names;
  for (const ReceiverInfo& receiver : receivers()) names.push_back(receiver.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Receivers, Unbiased, testing::ValuesIn(receiver_names()),
                         [](const auto& test) {
                           std::string name(test.param);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

// The variance of 2^17 samples, or of half as many pairs, against the exact one; its standard error
// by the measured fourth moment. 3 materials, 2 pixels, fewer than 32 estimators with known
// moments; z = 6 for a family of 1e-6, and 8 for what the fourth moment's own error makes of it.
TEST(Variances, AreTheExactOnes) {
  constexpr double kZ = 8.0;
  constexpr std::uint64_t kCount = std::uint64_t{1} << 17U;
  for (const std::string_view name : {"lambert", "phong", "ggx"}) {
    const Stage stage("gradient", "sphere", material_by_name(name).material);
    for (std::size_t i = 0; i < stage.pixels.size(); ++i) {
      const Exact all(stage, i);
      for (const auto& [estimator, moments] : all.of_estimator) {
        const EstimatorInfo& info = estimator_by_name(estimator);
        Moments measured;
        stage.bound(info).integrate(
            stage.pixels[i].point,
            RandomStream(fmt::format("variance/{}/{}/{}", name, info.name, i), 1), {0, kCount},
            [&](std::span<const Rgb> shown) {
              for (const Rgb rgb : shown) measured.add(luminance_of(rgb));
            });
        const double scale = static_cast<double>(info.samples_per_estimate);
        ASSERT_EQ(measured.count(), kCount / info.samples_per_estimate);
        const double variance = measured.variance();
        const double error = std::sqrt((measured.fourth_central() - variance * variance) /
                                       static_cast<double>(measured.count()));
        const double exact = moments.front().variance;
        EXPECT_NEAR(variance, exact / scale, kZ * error + 1e-9 * exact)
            << info.name << ", " << name << ", pixel " << i;
      }
    }
  }
}

/// The variance of single samples, relative to the square of the mean.
double relative_variance(const Stage& stage, std::string_view estimator, std::size_t pixel) {
  Moments measured;
  stage.bound(estimator_by_name(estimator))
      .integrate(stage.pixels[pixel].point, RandomStream("bound/" + std::string(estimator), 1),
                 {0, 16384}, [&](std::span<const Rgb> shown) {
                   for (const Rgb rgb : shown) measured.add(luminance_of(rgb));
                 });
  return measured.variance() / (measured.mean() * measured.mean());
}

// Without occlusion all that is left to the table of L k is how much k varies inside a texel, and
// the thousandth of the samples that go elsewhere. A texel of pi/64 radians: Lambert's cosine
// varies in it by (pi/64)^2/12 tan^2, some 2e-4 in the mean, and to a factor around one at the
// horizon, which is 2/64 of all texels and a thousandth of the light.
TEST(ProductTable, HasNextToNoVariance) {
  for (const std::string_view map : {"gradient", "sun-sky"}) {
    const Stage stage(map, "sphere", material_by_name("lambert").material, {128, 64});
    for (std::size_t i = 0; i < stage.pixels.size(); ++i) {
      EXPECT_LT(relative_variance(stage, "product table", i), 3e-3) << map;
    }
  }
}

// ... and less than any other density leaves, for every material: it is the bound.
TEST(ProductTable, IsTheBoundOfOneSampleEstimators) {
  for (const std::string_view map : {"gradient", "sun-sky"}) {
    for (const std::string_view material : {"phong", "ggx"}) {
      const Stage stage(map, "sphere", material_by_name(material).material, {256, 128});
      for (std::size_t i = 0; i < stage.pixels.size(); ++i) {
        const double bound = relative_variance(stage, "product table", i);
        for (const std::string_view other : {"environment B", "mis balance", "mis one-sample",
                                             "product two-level", "product hierarchical"}) {
          EXPECT_LT(bound, relative_variance(stage, other, i))
              << map << ", " << material << ", " << other;
        }
      }
    }
  }
}

// The more candidates, the closer to the product: with M candidates the variance without occlusion
// is that of a mean over M of their estimates, for what is chosen is weighed by that mean.
TEST(Resampling, DividesTheVarianceByTheCandidates) {
  const Stage stage("gradient", "sphere", material_by_name("lambert").material);
  for (std::size_t i = 0; i < stage.pixels.size(); ++i) {
    const double one = relative_variance(stage, "mis one-sample", i);
    // 16384 estimates, of a kurtosis near 3: variances are known to sqrt(2/16384) = 1.1 %, the
    // ratio of two to 1.6 %, six times of which is 10 %. The gradient's colour is one and the same.
    EXPECT_NEAR(relative_variance(stage, "ris 4", i) * 4.0 / one, 1.0, 0.1);
    EXPECT_NEAR(relative_variance(stage, "ris 16", i) * 16.0 / one, 1.0, 0.1);
    EXPECT_NEAR(relative_variance(stage, "ris 64", i) * 64.0 / one, 1.0, 0.1);
  }
}

// What the table says of a direction's density is what it draws, but for the step of its sums: in
// every measure of texels and positions, with and without compensation.
TEST(EnvironmentTable, DrawsTheDensityThatItSays) {
  const EnvironmentMap map = make_synthetic_map("gradient", {64, 32});
  for (const DensitySpace density_space : kDensitySpaces) {
    for (const double compensation : {0.0, 0.5, 1.0}) {
      const EnvironmentTable table(map, density_space, compensation);
      LightSamples samples;
      samples.count = LightSamples::kCapacity;
      table.draw(BatchPoints(RandomStream("table", 1), 0), samples);
      for (std::size_t i = 0; i < samples.count; ++i) {
        const double says = table.pdf(map.radiance(samples.column[i], samples.row[i]),
                                      samples.row[i], std::hypot(samples.x[i], samples.y[i]));
        // A texel has some 2^31/64 units of its row; compensated ones a hundredth of that, and
        // float luminances there six digits.
        EXPECT_NEAR(samples.pdf[i] / says, 1.0, 1e-4)
            << to_string(density_space) << ", " << compensation;
      }
    }
  }
}

// A constant map has nothing left above its mean, and is drawn from as it is; of a black one all
// samples are of the lobes, and nothing comes of them.
TEST(Compensation, FallsBackOnConstantAndBlackMaps) {
  const Stage stage("constant", "sphere", material_by_name("phong").material);
  const RandomStream stream("fall back", 1);
  const ShadingPoint& at = stage.pixels.front().point;
  const Rgb plain =
      stage.bound(estimator_by_name("mis balance")).integrate(at, stream, {0, 64}, {});
  EnvironmentMap black = stage.maps.front();
  std::ranges::fill(black.radiance.values(), Rgb(0.0F));
  for (const EstimatorInfo& info : estimators()) {
    if (!info.combined) continue;
    if (info.name == "mis balance compensated") {
      EXPECT_EQ(stage.bound(info).integrate(at, stream, {0, 64}, {}), plain);
    }
    const BoundEstimator dark = info.prepare(black).bind(stage.scene, stage.material);
    EXPECT_EQ(dark.integrate(at, stream, {0, 65}, {}), Rgb(0.0F)) << info.name;
  }
}

}  // namespace
}  // namespace lightproof
