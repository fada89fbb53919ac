#include "lightproof/prefilter/specular_comparisons.h"

#include <algorithm>
#include <cmath>

#include "lightproof/core/measure.h"
#include "lightproof/core/random.h"
#include "lightproof/prefilter/progressive.h"
#include "lightproof/prefilter/reflectivity.h"
#include "lightproof/prefilter/specular_chain.h"

namespace lightproof {
namespace {

/// 2^(-x/2): cos^x at 45 degrees, where a half-vector mirrors in the horizon.
double cosine_at_horizon(double x) { return std::exp2(-0.5 * x); }

/// The integral of u^x (2u - 1) from a to b.
double moment(double x, double a, double b) {
  const auto upto = [x](double u) {
    return 2.0 * std::pow(u, x + 2.0) / (x + 2.0) - std::pow(u, x + 1.0) / (x + 1.0);
  };
  return upto(b) - upto(a);
}

/// The integral of u^x from a to b.
double power_integral(double x, double a, double b) {
  return (std::pow(b, x + 1.0) - std::pow(a, x + 1.0)) / (x + 1.0);
}

}  // namespace

Comparison compare_hammersley_range(double cosine, double roughness, std::uint32_t count) {
  return {
      integrate_brdf(cosine, roughness, Masking::karis, HammersleyRange::published(count)).scale,
      integrate_brdf(cosine, roughness, Masking::karis, HammersleyRange{count, 0}).scale,
      integrate_brdf(cosine, roughness, Masking::karis).scale};
}

Comparison compare_masking(double cosine, double roughness, std::uint32_t count) {
  const HammersleyRange points = {count, 0};
  return {integrate_brdf(cosine, roughness, Masking::karis, points).scale,
          integrate_brdf(cosine, roughness, Masking::height_correlated, points).scale,
          integrate_brdf(cosine, roughness, Masking::height_correlated).scale};
}

Comparison compare_level_of_roughness(double roughness, int levels) {
  const double exact = level_of_roughness(roughness, levels);
  return {level_of_roughness_published(roughness, levels), exact, exact};
}

Comparison compare_progressive_mean(int frames) {
  SwappedBlend swapped;
  RunningMean<double> mean;
  for (int frame = 0; frame < frames; ++frame) {
    swapped.add(1.0, 16);
    mean.add(1.0, 16);
  }
  return {swapped.mean(), mean.mean(), 1.0};
}

Comparison compare_progressive_variance(int frames) {
  // Frame k keeps (k-1)/k of itself and 1/k of what was there.
  double squares = 0.0;
  for (int k = 1; k <= frames; ++k) {
    const double kept = 1.0 / k;
    squares = squares * kept * kept + (1.0 - kept) * (1.0 - kept);
  }
  return {squares, 1.0 / frames, 1.0 / frames};
}

Comparison compare_progressive_precision(std::uint64_t samples) {
  const RandomStream stream("progressive/precision", 1);
  constexpr double kProbability = 1e-3;
  PublishedBlend blend;
  RunningMean<double> mean;
  std::uint64_t hits = 0;
  for (std::uint64_t i = 0; i < samples; ++i) {
    const bool hit = stream.point(i).s < kProbability;
    blend.add(hit ? 1000.0F : 0.0F, 1);
    mean.add(hit ? 1000.0 : 0.0, 1);
    if (hit) ++hits;
  }
  return {static_cast<double>(blend.mean()), mean.mean(),
          1000.0 * static_cast<double>(hits) / static_cast<double>(samples)};
}

Comparison compare_shininess(int level, int levels) {
  const double exact = half_vector_shininess(reflectivity_roughness(level, levels));
  return {half_vector_shininess(reflectivity_roughness_published(level)), exact, exact};
}

Comparison compare_half_vector_density() { return {2.0 * kPi, 1.0, 1.0}; }

Comparison compare_weight_mean(double shininess) {
  // cos(theta) has the mean (S+1)/(S+2).
  const double cosine = (shininess + 1.0) / (shininess + 2.0);
  return {reflectivity_weight_published(shininess, cosine), reflectivity_weight(shininess, cosine),
          1.0};
}

Comparison compare_white_map(double roughness) {
  const double shininess = half_vector_shininess(roughness);
  const double published = 2.0 / kPi * (1.0 - cosine_at_horizon(shininess + 2.0)) /
                           (1.0 - half_vector_below_horizon(shininess));
  return {published, 1.0, 1.0};
}

Comparison compare_repeated_draws(double roughness, int samples) {
  const double shininess = half_vector_shininess(roughness);
  const double skipped = std::max(half_vector_below_horizon(shininess), skipped_share(shininess));
  return {std::pow(skipped, samples) / (1.0 - skipped), 0.0, 0.0};
}

Comparison compare_geometry(double roughness) {
  const double shininess = half_vector_shininess(roughness);
  const double exact = white_with_cook_torrance(shininess);
  return {white_with_cosine_geometry(shininess), exact, exact};
}

Comparison compare_height(int width) {
  const auto exact = static_cast<double>(reflectivity_extent(width).height);
  return {static_cast<double>(reflectivity_extent_published(width).height), exact, exact};
}

Comparison compare_fresnel_at_mirror(double f0, double cosine, double roughness) {
  const ScaleBias split = integrate_brdf(cosine, roughness, Masking::height_correlated);
  const double mirrored = f0 + (1.0 - f0) * std::pow(1.0 - cosine, 5.0);
  return {mirrored * (split.scale + split.bias), split.reflected(f0), split.reflected(f0)};
}

double ggx_below_horizon(double alpha) { return alpha * alpha / (1.0 + alpha * alpha); }

double half_vector_below_horizon(double shininess) { return cosine_at_horizon(shininess + 1.0); }

double skipped_share(double shininess) {
  if (shininess == 0.0) return 0.0;
  return std::pow(1e-4 / (shininess + 1.0), (shininess + 1.0) / shininess);
}

double weight_variance(double shininess) { return 1.0 / ((shininess + 1.0) * (shininess + 3.0)); }

// With D = (S+2)/2pi u^(S/2), u = (1 + n·l)/2 the squared cosine of the half-vector's angle:
// 1/4 of 2pi D over n·l from 0 to 1 is (S+2)/2 du over u from 1/2 to 1.
double white_without_geometry(double shininess) { return 1.0 - cosine_at_horizon(shininess + 2.0); }

double white_with_cosine_geometry(double shininess) {
  return 2.0 * (shininess + cosine_at_horizon(shininess)) / (shininess + 4.0);
}

double white_with_cook_torrance(double shininess) {
  const double x = 0.5 * shininess;
  return 0.5 * (shininess + 2.0) * (2.0 * moment(x, 0.5, 0.75) + power_integral(x, 0.75, 1.0));
}

}  // namespace lightproof
