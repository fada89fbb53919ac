#include "lightproof/prefilter/specular_comparisons.h"

#include <algorithm>
#include <cmath>

#include "lightproof/core/measure.h"
#include "lightproof/core/random.h"
#include "lightproof/prefilter/brdf_map.h"
#include "lightproof/prefilter/progressive.h"
#include "lightproof/prefilter/reflectivity.h"
#include "lightproof/prefilter/specular_chain.h"

namespace lightproof {
namespace {

/// cos^x at 45 degrees, where a half-vector mirrors in the horizon.
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

PublishedComparison hammersley_range_comparison(double cosine, double roughness,
                                                std::uint32_t count) {
  const auto scale = [&](std::uint32_t first) {
    return integrate_brdf(cosine, roughness, Masking::karis, HammersleyRange{count, first}).scale;
  };
  return {"002-5", "scale of the BRDF map: Hammersley points 1 to N against 0 to N-1",
          integrate_brdf(cosine, roughness, Masking::karis).scale, scale(1), scale(0)};
}

PublishedComparison masking_comparison(double cosine, double roughness, std::uint32_t count) {
  const auto scale = [&](Masking masking) {
    return integrate_brdf(cosine, roughness, masking, HammersleyRange{count, 0}).scale;
  };
  return {"002-5", "scale of the BRDF map: Karis's masking against Smith's, height-correlated",
          integrate_brdf(cosine, roughness, Masking::height_correlated).scale,
          scale(Masking::karis), scale(Masking::height_correlated)};
}

PublishedComparison level_of_roughness_comparison(double roughness, int levels) {
  const double exact = level_of_roughness(roughness, levels);
  return {"002-6", "level of a roughness: R mipCount against R (mipCount - 1)", exact,
          level_of_roughness_published(roughness, levels), exact};
}

PublishedComparison progressive_mean_comparison(int frames) {
  SwappedBlend swapped;
  RunningMean<double> mean;
  for (int frame = 0; frame < frames; ++frame) {
    swapped.add(1.0, 16);
    mean.add(1.0, 16);
  }
  return {"004-1", "mean of frames of mean 1, with swapped weights", 1.0, swapped.mean(),
          mean.mean()};
}

PublishedComparison progressive_variance_comparison(int frames) {
  // Frame k keeps (k-1)/k of itself and 1/k of what was there.
  double squares = 0.0;
  for (int k = 1; k <= frames; ++k) {
    const double kept = 1.0 / k;
    squares = squares * kept * kept + (1.0 - kept) * (1.0 - kept);
  }
  return {"004-1", "variance that is left after the frames, with swapped weights", 1.0 / frames,
          squares, 1.0 / frames};
}

PublishedComparison progressive_precision_comparison(std::uint64_t samples) {
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
  return {"004-1", "mean of rare samples of 1000, blended in single precision",
          1000.0 * static_cast<double>(hits) / static_cast<double>(samples),
          static_cast<double>(blend.mean()), mean.mean()};
}

PublishedComparison shininess_comparison(int level, int levels) {
  const double exact = half_vector_shininess(reflectivity_roughness(level, levels));
  return {"004-4", "shininess of a level, its roughness not divided by the number of levels", exact,
          half_vector_shininess(reflectivity_roughness_published(level)), exact};
}

PublishedComparison half_vector_density_comparison() {
  return {"004-5", "integral of the half-vector's density over the hemisphere", 1.0, 2.0 * kPi,
          1.0};
}

PublishedComparison weight_comparison(double shininess) {
  const double mean_cosine = (shininess + 1.0) / (shininess + 2.0);
  return {"004-6", "mean weight of a draw", 1.0,
          reflectivity_weight_published(shininess, mean_cosine),
          reflectivity_weight(shininess, mean_cosine)};
}

PublishedComparison white_map_comparison(double roughness) {
  const double shininess = half_vector_shininess(roughness);
  const double published = 2.0 / kPi * (1.0 - cosine_at_horizon(shininess + 2.0)) /
                           (1.0 - half_vector_below_horizon(shininess));
  return {"004-7", "reflectivity of a white map, renormalised by the samples that are left", 1.0,
          published, 1.0};
}

PublishedComparison repeated_draws_comparison(double roughness, int samples) {
  const double shininess = half_vector_shininess(roughness);
  const double skipped = std::max(half_vector_below_horizon(shininess), skipped_share(shininess));
  return {"004-8", "random numbers of a frame that the next frame draws again", 0.0,
          std::pow(skipped, samples) / (1.0 - skipped), 0.0};
}

PublishedComparison geometry_comparison(double roughness) {
  const double shininess = half_vector_shininess(roughness);
  const double exact = white_with_cook_torrance(shininess);
  return {"004-9", "reflectivity of a white map with G = 2 n·l against Cook and Torrance's", exact,
          white_with_cosine_geometry(shininess), exact};
}

PublishedComparison height_comparison(int width) {
  const auto exact = static_cast<double>(reflectivity_extent(width).height);
  return {"004-10", "height of a reflectivity map", exact,
          static_cast<double>(reflectivity_extent_published(width).height), exact};
}

PublishedComparison fresnel_at_mirror_comparison(double f0, double cosine, double roughness) {
  const ScaleBias split = integrate_brdf(cosine, roughness, Masking::height_correlated);
  const double mirrored = f0 + (1.0 - f0) * std::pow(1.0 - cosine, 5.0);
  return {"004-14", "reflection of a white sky, the Fresnel factor taken out of the integral",
          split.reflected(f0), mirrored * (split.scale + split.bias), split.reflected(f0)};
}

std::vector<PublishedComparison> specular_comparisons() {
  return {hammersley_range_comparison(0.1, 0.5, 1024),
          masking_comparison(0.1, 0.5, 1024),
          level_of_roughness_comparison(1.0, 9),
          progressive_mean_comparison(2),
          progressive_variance_comparison(100),
          progressive_precision_comparison(10'000'000),
          shininess_comparison(3, kReflectivityLevels),
          half_vector_density_comparison(),
          weight_comparison(30.0),
          white_map_comparison(1.0),
          repeated_draws_comparison(1.0, 16),
          geometry_comparison(0.5),
          height_comparison(1024),
          fresnel_at_mirror_comparison(0.04, 0.1, 0.5)};
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
