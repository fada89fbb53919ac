// The integrator against quadrature where nothing is in the way, and every strategy against
// uniform sampling where something is.
#include "lightproof/render/direct_lighting.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "lightproof/core/moments.h"
#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/render/picture.h"
#include "lightproof/stats/moment_tests.h"
#include "lightproof/study/exact_light.h"

namespace lightproof {
namespace {

/// All tests of this file together reject a correct integrator with probability 1e-6.
constexpr double kFamilyAlpha = 1e-6;

Moments luminance_moments(const Lighting& lighting, const ShadingPoint& point,
                          const RandomStream& stream, std::uint64_t samples) {
  constexpr std::uint64_t kTask = std::uint64_t{1} << 16U;
  std::vector<Moments> parts((samples + kTask - 1) / kTask);
  parallel_for(parts.size(), [&](std::size_t task) {
    LightBatch batch;
    const std::uint64_t end = std::min(samples, (task + 1) * kTask);
    for (std::uint64_t first = task * kTask; first < end; first += LightBatch::kCapacity) {
      const auto count = std::min<std::uint64_t>(LightBatch::kCapacity, end - first);
      for (const Rgb rgb : batch.estimate(lighting, point, stream, first, count)) {
        parts[task].add(luminance_of(rgb));
      }
    }
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
  EXPECT_LE(needed, 1.6e7) << "a case that normal tails do not fit";
  return static_cast<std::uint64_t>(std::min(needed, 1.6e7));
}

struct Case {
  std::string_view map;
  std::string_view receiver;
};

std::vector<Pixel> few_pixels(const ReceiverInfo& receiver, const Scene& scene) {
  return visible_pixels(receiver, scene, {3, 2});
}

class Unoccluded : public testing::TestWithParam<Case> {};

TEST_P(Unoccluded, EveryStrategyAgreesWithQuadrature) {
  const EnvironmentMap map = make_synthetic_map(GetParam().map, {128, 64});
  const EnvironmentLight light(map);
  const ReceiverInfo& receiver = receiver_by_name(GetParam().receiver);
  const Scene scene(receiver.content);
  const auto pixels = few_pixels(receiver, scene);
  const Grid<double> luminance = luminance_of(map);
  // 3 receivers, 3 maps, 2 materials, 4 strategies, at most 6 pixels.
  const double log10_level = std::log10(0.5 * kFamilyAlpha / (3 * 3 * 2 * 4 * 6));
  for (const MaterialInfo& material : materials()) {
    const auto exact = exact_light({&luminance, 1}, receiver, scene, material.material, pixels);
    for (const StrategyInfo& strategy : kStrategies) {
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        const auto& moments = moments_of(exact[0][i], strategy.strategy);
        const std::string name =
            fmt::format("{}/{}/{}/{}/{}", map.name, receiver.name, material.name, strategy.name, i);
        const Lighting lighting{&scene, &light, material.material, strategy.strategy};
        const bool constant = moments.variance() < 1e-8 * moments.raw[1];
        const Moments measured =
            luminance_moments(lighting, pixels[i].point, RandomStream("unoccluded/" + name, 1),
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

TEST_P(Occluded, EveryStrategyAgreesWithUniformSampling) {
  const EnvironmentMap map = make_synthetic_map(GetParam(), {128, 64});
  const EnvironmentLight light(map);
  const ReceiverInfo& receiver = receiver_by_name("sphere-on-plane");
  const Scene scene(receiver.content);
  const auto pixels = few_pixels(receiver, scene);
  const Grid<double> luminance = luminance_of(map);
  // 2 maps, 2 materials, 3 pairs, at most 6 pixels.
  const double log10_level = std::log10(0.5 * kFamilyAlpha / (2 * 2 * 3 * 6));
  for (const MaterialInfo& material : materials()) {
    const auto exact = exact_light({&luminance, 1}, receiver, scene, material.material, pixels);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const auto measure = [&](const StrategyInfo& strategy) {
        const std::string name =
            fmt::format("occluded/{}/{}/{}/{}", map.name, material.name, strategy.name, i);
        const auto& moments = moments_of(exact[0][i], strategy.strategy);
        return luminance_moments({&scene, &light, material.material, strategy.strategy},
                                 pixels[i].point, RandomStream(name, 1),
                                 samples_for_normal_tails(moments));
      };
      const Moments uniform = measure(kStrategies.front());
      for (std::size_t k = 1; k < kStrategies.size(); ++k) {
        const ZTest test = welch_test(measure(kStrategies[k]), uniform);
        EXPECT_GT(test.log10_p, log10_level) << material.name << ", " << kStrategies[k].name
                                             << ", pixel " << i << ": z = " << test.z;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, Occluded, testing::Values("gradient", "checker"));

TEST(Occlusion, TheSphereDarkensThePlaneBelowIt) {
  const EnvironmentMap map = make_synthetic_map("constant", {64, 32});
  const EnvironmentLight light(map);
  const Material material = Lambert{0.8};
  const ShadingPoint near = {{1.2, 0.0, -1.0 + kSurfaceOffset}, frame_around({0, 0, 1}), {0, 0, 1}};
  const Scene open({false, true});
  const Scene shaded({true, true});
  const RandomStream stream("darkens", 1);
  const auto mean = [&](const Scene& scene) {
    return luminance_moments({&scene, &light, material, Strategy::material}, near, stream, 65536)
        .mean();
  };
  // Cosine sampling of a constant map: albedo without a sphere, less than it with one.
  EXPECT_NEAR(mean(open), 0.8, 1e-6);
  EXPECT_LT(mean(shaded), 0.7);
}

TEST(Picture, TheSameBitsForAnyNumberOfThreads) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {64, 32});
  const EnvironmentLight light(map);
  const ReceiverInfo& receiver = receiver_by_name("sphere-on-plane");
  const Scene scene(receiver.content);
  const Lighting lighting{&scene, &light, ModifiedPhong{0.3, 0.6, 50.0}, Strategy::environment_b};
  const auto render = [&](int threads) {
    const ThreadLimit limit(threads);
    return render_picture(lighting, receiver, {32, 24}, 16, RandomStream("threads", 1));
  };
  const Grid<Rgb> one = render(1);
  for (const int threads : {2, 7}) {
    const Grid<Rgb> many = render(threads);
    EXPECT_TRUE(std::equal(one.values().begin(), one.values().end(), many.values().begin()));
  }
}

}  // namespace
}  // namespace lightproof
