// The first part of the split sum against the reflection that it stands for.
#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/image/synthetic.h"
#include "lightproof/prefilter/brdf_map.h"
#include "lightproof/prefilter/prefilter.h"
#include "reference/texel_integrals.h"

namespace lightproof {
namespace {

/// f_r (n·l)+ of GGX with F = 1 and separable masking, the textbook's.
reference::PeakedDensity ggx_reflection(double alpha, Direction normal, Direction view) {
  const auto value = [=](Direction light) {
    const double nl = glm::dot(normal, light);
    const double nv = glm::dot(normal, view);
    if (!(nl > 0.0)) return 0.0;
    const double nh = glm::dot(normal, glm::normalize(light + view));
    const double tilt = (alpha * alpha - 1.0) * nh * nh + 1.0;
    const auto masking = [alpha](double cosine) {
      const double tangent = std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) / cosine;
      return 2.0 / (1.0 + std::sqrt(1.0 + alpha * alpha * tangent * tangent));
    };
    return alpha * alpha / (kPi * tilt * tilt) * masking(nl) * masking(nv) / (4.0 * nv);
  };
  return {value, reflect_about(view, normal), alpha, normal, false};
}

double prefiltered_at(const Grid<Rgb>& map, double alpha, Direction axis) {
  const Lobe lobe = GgxLobe{alpha, GgxWeight::masking};
  return static_cast<double>(prefilter(map, lobe, {&axis, 1}).front().r);
}

const Direction kNormals[] = {
    {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, glm::normalize(Direction(0.5, 0.3, 0.6))};

TEST(SplitSum, IsExactAtNormalViewForEveryMap) {
  for (const std::string_view name : {"sun-sky", "checker", "gradient"}) {
    const Grid<Rgb> map = make_synthetic_map(name, {64, 32}).radiance;
    for (const double roughness : {0.3, 0.6, 1.0}) {
      const double alpha = roughness * roughness;
      const ScaleBias split = integrate_brdf(1.0, roughness, Masking::separable);
      for (const Direction normal : kNormals) {
        const double exact = reference::reflected(map, ggx_reflection(alpha, normal, normal)).x;
        // The reference's 1e-5, and the masking's kink at the horizon, which harmonics leave 1e-4
        // of.
        EXPECT_NEAR(prefiltered_at(map, alpha, normal) * split.reflected(1.0), exact,
                    1.1e-4 * exact + 1e-5)
            << name << " " << roughness;
      }
    }
  }
}

TEST(SplitSum, IsBiasedAtOtherViews) {
  // White light shows no bias: A + B is exact. A step does, by several percent: the lobe is
  // stretched and does not stand on the mirrored view any more.
  const Direction normal = {0.0, 0.0, 1.0};
  const Direction view = {std::sin(1.2), 0.0, std::cos(1.2)};
  constexpr double kRoughness = 0.6;
  constexpr double kAlpha = 0.36;
  const ScaleBias split = integrate_brdf(view.z, kRoughness, Masking::separable);
  const auto relative_bias = [&](const Grid<Rgb>& map) {
    const double exact = reference::reflected(map, ggx_reflection(kAlpha, normal, view)).x;
    const double sum =
        prefiltered_at(map, kAlpha, reflect_about(view, normal)) * split.reflected(1.0);
    return sum / exact - 1.0;
  };
  EXPECT_NEAR(relative_bias(make_synthetic_map("constant", {64, 32}).radiance), 0.0, 2e-5);
  Grid<Rgb> step({64, 32});
  for (int y = 16; y < 32; ++y) {
    for (int x = 32; x < 64; ++x) step(x, y) = Rgb(1.0F);
  }
  EXPECT_GT(std::abs(relative_bias(step)), 0.02);
}

}  // namespace
}  // namespace lightproof
