#include "lightproof/shading/split_sum_error.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "lightproof/core/moments.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/random.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/materials/microfacet.h"
#include "lightproof/prefilter/specular_chain.h"
#include "lightproof/warp/lat_long.h"
#include "reference/microfacet_reflectance.h"

namespace lightproof {
namespace {

constexpr std::array kReflectances = {0.04, 1.0};

/// Texel by texel, each of them in cells of equal steps.
template <class Integrand>
glm::dvec3 integral_over_sphere(Extent extent, int cells, const Integrand& integrand) {
  const Extent fine = {extent.width * cells, extent.height * cells};
  glm::dvec3 sum(0.0);
  for (int y = 0; y < fine.height; ++y) {
    const double area = texel_solid_angle(fine, y);
    for (int x = 0; x < fine.width; ++x) {
      const Direction direction =
          direction_from_square({(x + 0.5) / fine.width, (y + 0.5) / fine.height});
      sum += area * integrand(direction, x / cells, y / cells);
    }
  }
  return sum;
}

ShadingPoint point_at(Frame frame, double cosine) {
  const double sine = std::sqrt(1.0 - cosine * cosine);
  return {glm::dvec3(0.0), frame, frame.to_world({sine, 0.0, cosine})};
}

double reflection(double roughness, double f0, const ShadingPoint& at, Direction light) {
  return Ggx{roughness, f0}.evaluate(at, light).reflected_cosine;
}

TEST(SplitSumKernels, ReflectWhatTheSurfaceReflectsOfAWhiteSky) {
  for (const double roughness : {0.2, 0.5, 1.0}) {
    for (const double cosine : {1.0, 0.5, 0.17}) {
      const reference::SplitSum exact =
          reference::split_sum({{reference::NormalDistribution::Kind::ggx, roughness * roughness},
                                reference::Masking::smith_height_correlated},
                               cosine);
      const auto kernels = split_sum_kernels(roughness, cosine, kReflectances);
      for (std::size_t i = 0; i < kReflectances.size(); ++i) {
        EXPECT_NEAR(kernels[i].reflectance, exact.of(kReflectances[i]), 1e-6)
            << roughness << " " << cosine;
        // Both parts of the difference reflect as much.
        EXPECT_LT(kernels[i].difference.of_degree[0], 1e-10);
      }
    }
  }
}

TEST(SplitSumKernels, HaveTheFirstMomentsOfTheSurfaceAndTheLobe) {
  const double roughness = 0.7;
  const double cosine = 0.5;
  const ShadingPoint at = point_at(frame_around({0.0, 0.0, 1.0}), cosine);
  const Direction mirrored = reflect_about(at.view, at.frame.normal);
  const double shrink = zonal_factors(*ggx_lobe(roughness), 1)[1];
  const auto kernels = split_sum_kernels(roughness, cosine, kReflectances);
  for (std::size_t i = 0; i < kReflectances.size(); ++i) {
    const glm::dvec3 moment = integral_over_sphere({64, 32}, 16, [&](Direction l, int, int) {
      return l * reflection(roughness, kReflectances[i], at, l);
    });
    const glm::dvec3 difference = moment - kernels[i].reflectance * shrink * mirrored;
    EXPECT_NEAR(kernels[i].difference.of_degree[1],
                3.0 / kSphere * glm::dot(difference, difference),
                1e-4 * kernels[i].difference.of_degree[1]);
  }
}

TEST(SplitSumError, IsNoneUnderAConstantSky) {
  const AngularPower white = luminance_power(make_synthetic_map("constant", {64, 32}));
  for (const SplitSumKernel& kernel : split_sum_kernels(0.6, 0.3, kReflectances)) {
    const SplitSumError error = split_sum_error(kernel, white);
    EXPECT_LT(error.rmse, 1e-6);
    EXPECT_LT(error.left_out, 1e-6);
  }
}

TEST(SplitSumError, OfALinearSkyIsItsGradientTimesTheFirstMomentOverTheRootOfThree) {
  constexpr Extent kFine = {512, 256};
  const EnvironmentMap map = make_synthetic_map("gradient", kFine);
  const auto luminance = [&](int y) { return luminance_of(map.radiance(0, y)); };
  const double height = direction_from_square({0.5 / kFine.width, 0.5 / kFine.height}).z;
  const double slope = (luminance(kFine.height - 1) - luminance(0)) / (-2.0 * height);
  const double mean = 0.5 * (luminance(kFine.height - 1) + luminance(0));
  for (const SplitSumKernel& kernel : split_sum_kernels(0.7, 0.5, kReflectances)) {
    const double moment = std::sqrt(kernel.difference.of_degree[1] * kSphere / 3.0);
    const double expected = slope * moment / std::sqrt(3.0) / (mean * kernel.reflectance);
    // Texels of 0.7 degrees, each constant, are linear to 1e-4.
    EXPECT_NEAR(split_sum_error(kernel, luminance_power(map)).rmse, expected, 2e-4 * expected);
  }
}

TEST(SplitSumError, OfABlackMapIsNone) {
  EnvironmentMap black{"black", Grid<Rgb>(Extent{8, 4})};
  const AngularPower power = luminance_power(black);
  EXPECT_EQ(split_sum_error(split_sum_kernels(0.6, 0.3, kReflectances)[0], power).rmse, 0.0);
}

/// Means over random orientations, of the map `checker`, with their standard errors.
struct Orientations {
  Moments exact;
  Moments squared_error;
};

std::vector<ShadingPoint> drawn_points(double cosine) {
  const RandomStream stream("orientations", 1);
  std::vector<ShadingPoint> points;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const SquarePoint p = stream.point(2 * i);
    const double z = 2.0 * p.t - 1.0;
    const double phi = 2.0 * kPi * p.s;
    const double radius = std::sqrt(1.0 - z * z);
    const Frame around = frame_around({radius * std::cos(phi), radius * std::sin(phi), z});
    const double turn = 2.0 * kPi * stream.point(2 * i + 1).s;
    const Direction tangent = std::cos(turn) * around.tangent + std::sin(turn) * around.bitangent;
    points.push_back(
        point_at({tangent, glm::cross(around.normal, tangent), around.normal}, cosine));
  }
  return points;
}

Orientations drawn_orientations(const EnvironmentMap& map, double roughness, double cosine,
                                const SplitSumKernel& kernel, double f0) {
  const std::vector<ShadingPoint> points = drawn_points(cosine);
  std::vector<Direction> mirrored;
  for (const ShadingPoint& at : points) {
    mirrored.push_back(reflect_about(at.view, at.frame.normal));
  }
  const std::vector<Rgb> split = prefilter(map.radiance, ggx_lobe(roughness), mirrored);
  std::vector<double> exact(points.size());
  parallel_for(points.size(), [&](std::size_t i) {
    const auto light = [&](Direction l, int x, int y) {
      return glm::dvec3(luminance_of(map.radiance(x, y))) * reflection(roughness, f0, points[i], l);
    };
    exact[i] = integral_over_sphere(map.radiance.extent(), 8, light).x;
  });
  Orientations sums;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double error = kernel.reflectance * luminance_of(split[i]) - exact[i];
    sums.exact.add(exact[i]);
    sums.squared_error.add(error * error);
  }
  return sums;
}

TEST(SplitSumError, IsTheRootMeanSquareOverAllOrientations) {
  const EnvironmentMap map = make_synthetic_map("checker", {32, 16});
  const double cosine = 0.5;
  const double roughness = 0.5;
  const AngularPower power = luminance_power(map);
  const auto kernels = split_sum_kernels(roughness, cosine, kReflectances);
  for (std::size_t i = 0; i < kReflectances.size(); ++i) {
    const Orientations drawn =
        drawn_orientations(map, roughness, cosine, kernels[i], kReflectances[i]);
    const double mean = std::sqrt(power.of_degree[0] / kSphere) * kernels[i].reflectance;
    const double count = static_cast<double>(drawn.exact.count());
    EXPECT_NEAR(drawn.exact.mean(), mean, 4.5 * std::sqrt(drawn.exact.variance() / count));
    const double expected = std::pow(split_sum_error(kernels[i], power).rmse * mean, 2.0);
    EXPECT_NEAR(drawn.squared_error.mean(), expected,
                4.5 * std::sqrt(drawn.squared_error.variance() / count));
  }
}

TEST(SplitSumError, LeavesOutNoMoreThanItSays) {
  const EnvironmentMap map = make_synthetic_map("sun-sky", {128, 64});
  const double cosine = std::cos(60.0 * kPi / 180.0);
  const SplitSumError all =
      split_sum_error(split_sum_kernels(0.3, cosine, kReflectances)[0], luminance_power(map));
  for (const int degree : {10, 20, 40}) {
    const SplitSumError part = split_sum_error(
        split_sum_kernels(0.3, cosine, kReflectances, degree)[0], luminance_power(map, degree));
    EXPECT_LT(part.rmse, all.rmse);
    EXPECT_GT(std::hypot(part.rmse, part.left_out), all.rmse) << degree;
  }
}

TEST(LuminancePower, OfAWideMapIsThatOfItsMeans) {
  const EnvironmentMap wide = make_synthetic_map("gradient", {2048, 64});
  const EnvironmentMap narrow = make_synthetic_map("gradient", {1024, 32});
  const AngularPower one = luminance_power(wide, 3);
  const AngularPower other = luminance_power(narrow, 3);
  EXPECT_NEAR(one.of_degree[0], other.of_degree[0], 1e-5 * other.of_degree[0]);
  EXPECT_NEAR(one.of_degree[1], other.of_degree[1], 1e-2 * other.of_degree[1]);
}

}  // namespace
}  // namespace lightproof
