// Every estimator whose single estimates have known moments, against quadrature where nothing is in
// the way, and against uniform sampling where something is.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "lightproof/accuracy/exact_light.h"
#include "lightproof/core/error.h"
#include "lightproof/core/moments.h"
#include "lightproof/core/parallel.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/render/receiver.h"
#include "lightproof/stats/moment_tests.h"

namespace lightproof {
namespace {

/// All tests of this file together reject a correct integrator with probability 1e-6.
constexpr double kFamilyAlpha = 1e-6;

Moments luminance_moments(const BoundEstimator& estimator, const ShadingPoint& point,
                          const RandomStream& stream, std::uint64_t samples) {
  constexpr std::uint64_t kTask = std::uint64_t{1} << 16U;
  std::vector<Moments> parts((samples + kTask - 1) / kTask);
  parallel_for(parts.size(), [&](std::size_t task) {
    const std::uint64_t first = task * kTask;
    estimator.integrate(point, stream, {first, std::min(samples - first, kTask)},
                        [&](std::span<const Rgb> estimates) {
                          for (const Rgb rgb : estimates) parts[task].add(luminance_of(rgb));
                        });
  });
  Moments all;
  for (const Moments& part : parts) all.merge(part);
  return all;
}

/// The number of samples at which the first two terms of Edgeworth's expansion change a p-value at
/// z = 6 by no more than a factor e^(1/3) each: z^3 skewness / (6 sqrt N) and z^4 kurtosis / (24
/// N).
std::uint64_t samples_for_normal_tails(const reference::EstimatorMoments& exact) {
  constexpr double kZ = 6.0;
  const double variance = std::max(exact.variance(), 1e-300);
  const double m = exact.mean();
  const double third = exact.raw[2] - 3.0 * m * exact.raw[1] + 2.0 * m * m * m;
  const double root = 0.5 * kZ * kZ * kZ * third / std::pow(variance, 1.5);
  const double kurtosis = exact.fourth_central() / (variance * variance);
  const double needed = std::max({65536.0, root * root, kZ * kZ * kZ * kZ * kurtosis / 8.0});
  EXPECT_LE(needed, 2.5e7) << "a case that normal tails do not fit";
  return static_cast<std::uint64_t>(std::min(needed, 2.5e7));
}

/// Those that are means of independent estimates, of one density with known moments, and studied;
/// unbiased_test.cpp has all.
std::vector<EstimatorInfo> one_sample_estimators() {
  std::vector<EstimatorInfo> rows;
  for (const EstimatorInfo& info : estimators()) {
    if (!info.density || !info.is_studied) continue;
    EXPECT_EQ(info.kind, EstimatorKind::one_sample) << info.name;
    rows.push_back(info);
  }
  return rows;
}

/// Whether its estimates are means of independent ones.
bool shows_estimates(const EstimatorInfo& info) {
  return info.kind == EstimatorKind::one_sample || info.kind == EstimatorKind::multi_sample ||
         info.kind == EstimatorKind::resampled;
}

struct Case {
  std::string_view map;
  std::string_view receiver;
};

std::vector<Pixel> few_pixels(const ReceiverInfo& receiver, const Scene& scene) {
  return visible_pixels(receiver, scene, {3, 2});
}

// Materials that studies leave out are not here either: whose normals are drawn whatever the view,
// they have rare, large weights where it grazes, and no normal tails.
class Unoccluded : public testing::TestWithParam<Case> {};

TEST_P(Unoccluded, EveryEstimatorAgreesWithQuadrature) {
  const EnvironmentMap map = make_synthetic_map(GetParam().map, {128, 64});
  const ReceiverInfo& receiver = receiver_by_name(GetParam().receiver);
  const Scene scene(receiver.content);
  const auto pixels = few_pixels(receiver, scene);
  const Grid<double> luminance = luminance_of(map);
  // 3 receivers, 3 maps, the materials, 4 estimators, at most 6 pixels.
  const double tests = 3.0 * 3.0 * static_cast<double>(materials().size()) * 4.0 * 6.0;
  const double log10_level = std::log10(0.5 * kFamilyAlpha / tests);
  for (const MaterialInfo& material : materials()) {
    if (!material.is_studied) continue;
    const auto exact = exact_light({&luminance, 1}, receiver, scene, material.material, pixels);
    for (const EstimatorInfo& info : one_sample_estimators()) {
      const BoundEstimator estimator = info.prepare(map).bind(scene, material.material);
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        const reference::EstimatorMoments& moments = exact[0][i][info.density.value()];
        const std::string name =
            fmt::format("{}/{}/{}/{}/{}", map.name, receiver.name, material.name, info.name, i);
        const bool constant = moments.variance() < 1e-8 * moments.raw[1];
        const Moments measured =
            luminance_moments(estimator, pixels[i].point, RandomStream("unoccluded/" + name, 1),
                              constant ? 65536 : samples_for_normal_tails(moments));
        if (constant) {
          // No variance but the quadrature's error; float radiance and weights, a few roundings.
          EXPECT_NEAR(measured.mean() / moments.mean(), 1.0, 1e-6) << name;
          continue;
        }
        const ZTest test = mean_test(measured, {moments.mean(), moments.variance()});
        EXPECT_GT(test.log10_p, log10_level) << name << ": z = " << test.z;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Unoccluded,
                         testing::Values(Case{"gradient", "point"}, Case{"gradient", "sphere"},
                                         Case{"gradient", "plane"}, Case{"constant", "point"},
                                         Case{"constant", "sphere"}, Case{"constant", "plane"},
                                         Case{"checker", "point"}, Case{"checker", "sphere"},
                                         Case{"checker", "plane"}));

class Occluded : public testing::TestWithParam<std::string_view> {};

TEST_P(Occluded, EveryEstimatorAgreesWithUniformSampling) {
  const EnvironmentMap map = make_synthetic_map(GetParam(), {128, 64});
  const ReceiverInfo& receiver = receiver_by_name("sphere-on-plane");
  const Scene scene(receiver.content);
  const auto pixels = few_pixels(receiver, scene);
  const Grid<double> luminance = luminance_of(map);
  // 2 maps, the materials, 3 pairs, at most 6 pixels.
  const double tests = 2.0 * static_cast<double>(materials().size()) * 3.0 * 6.0;
  const double log10_level = std::log10(0.5 * kFamilyAlpha / tests);
  for (const MaterialInfo& material : materials()) {
    if (!material.is_studied) continue;
    const auto exact = exact_light({&luminance, 1}, receiver, scene, material.material, pixels);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const auto measure = [&](const EstimatorInfo& info) {
        const std::string name =
            fmt::format("occluded/{}/{}/{}/{}", map.name, material.name, info.name, i);
        return luminance_moments(info.prepare(map).bind(scene, material.material), pixels[i].point,
                                 RandomStream(name, 1),
                                 samples_for_normal_tails(exact[0][i][info.density.value()]));
      };
      const Moments uniform = measure(estimator_by_name("uniform"));
      for (const EstimatorInfo& info : one_sample_estimators()) {
        if (info.name == "uniform") continue;
        const ZTest test = welch_test(measure(info), uniform);
        EXPECT_GT(test.log10_p, log10_level)
            << material.name << ", " << info.name << ", pixel " << i << ": z = " << test.z;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, Occluded, testing::Values("gradient", "checker"));

// What is shown one by one is what the estimate is the mean of; a budget that begins later goes on
// where the one before ended.
TEST(Estimators, AreTheMeanOfWhatTheyShow) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  const ReceiverInfo& receiver = receiver_by_name("sphere-on-plane");
  const Scene scene(receiver.content);
  const ShadingPoint at = few_pixels(receiver, scene)[0].point;
  const RandomStream stream("mean", 1);
  for (const EstimatorInfo& info : estimators()) {
    if (!shows_estimates(info)) continue;
    const Material& material = material_by_name("ggx").material;
    const BoundEstimator estimator = info.prepare(map).bind(scene, material);
    std::vector<Rgb> shown;
    const auto show = [&](std::span<const Rgb> some) {
      shown.insert(shown.end(), some.begin(), some.end());
    };
    const Rgb whole = estimator.integrate(at, stream, {0, 1000}, show);
    const std::size_t count = 1000 / info.samples_per_estimate;
    ASSERT_EQ(shown.size(), count) << info.name;
    glm::dvec3 sum(0.0);
    for (const Rgb rgb : shown) sum += glm::dvec3(rgb);
    // Pairs were rounded to float; sums over techniques were not.
    const double mean = luminance_of(Rgb(sum / static_cast<double>(count)));
    EXPECT_NEAR(luminance_of(whole) / mean, 1.0, 1e-6) << info.name;
    const std::vector<Rgb> before = std::move(shown);
    shown.clear();
    estimator.integrate(at, stream, {600, 400}, show);
    const auto tail = before.begin() + static_cast<std::ptrdiff_t>(600 / info.samples_per_estimate);
    EXPECT_TRUE(std::equal(shown.begin(), shown.end(), tail, before.end())) << info.name;
  }
}

TEST(Estimators, RefuseTexelsThatAreNotThoseOfLatitudeAndLongitude) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {16, 16}, {MappingKind::octahedral});
  for (const EstimatorInfo& info : estimators()) {
    EXPECT_THROW(info.prepare(map), InputError) << info.name;
  }
}

TEST(Estimators, KeepATableUnlessTheyDrawFromLobesAlone) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  for (const EstimatorInfo& info : estimators()) {
    const bool is_without = info.name == "uniform" || info.name == "hemisphere" ||
                            info.name == "cosine" || info.name == "riemann" ||
                            info.name.starts_with("brdf") || info.name.starts_with("ggx");
    const PreparedEstimator prepared = info.prepare(map);
    std::size_t bytes = prepared.bytes;
    for (const MaterialInfo& material : materials()) {
      if (!info.serves(material.material)) continue;
      bytes += prepared.bind(Scene({false, false}), material.material).bytes;
      break;
    }
    EXPECT_EQ(bytes == 0, is_without) << info.name;
    if (info.name.starts_with("environment")) {
      const auto side = static_cast<std::size_t>(info.table_reduction);
      EXPECT_GT(bytes, 64U * 32U / (side * side)) << info.name;
    }
  }
}

TEST(Estimators, AreTwentyFiveOrMore) {
  EXPECT_GE(estimators().size(), 25U);
  std::set<EstimatorKind> kinds;
  for (const EstimatorInfo& info : estimators()) kinds.insert(info.kind);
  EXPECT_EQ(kinds.size(), 6U);
}

TEST(Estimators, HaveNamesThatAreFoundAndDiffer) {
  std::set<std::string_view> names;
  for (const EstimatorInfo& info : estimators()) {
    names.insert(info.name);
    EXPECT_EQ(&estimator_by_name(info.name), &info);
    EXPECT_FALSE(info.source.empty());
  }
  EXPECT_EQ(names.size(), estimators().size());
  EXPECT_THROW(estimator_by_name("environment Z"), InputError);
}

}  // namespace
}  // namespace lightproof
