#include "lightproof/prefilter/brdf_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/parallel.h"
#include "lightproof/points/hammersley.h"
#include "lightproof/prefilter/brdf_quadrature.h"
#include "lightproof/prefilter/lobe_samples.h"
#include "lightproof/warp/hemisphere.h"

namespace lightproof {
namespace {

double smith_masking(double alpha, double cosine) {
  return 2.0 * cosine /
         (cosine + std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine));
}

double geometry(Masking masking, double alpha, double view, double light) {
  switch (masking) {
    case Masking::karis: {
      const double k = 0.5 * alpha;
      return view / (view * (1.0 - k) + k) * light / (light * (1.0 - k) + k);
    }
    case Masking::separable:
      return smith_masking(alpha, view) * smith_masking(alpha, light);
    case Masking::height_correlated:
      break;
  }
  // 1/(1 + Lambda(v) + Lambda(l)), and 1 + Lambda = 1/G1.
  return 1.0 / (1.0 / smith_masking(alpha, view) + 1.0 / smith_masking(alpha, light) - 1.0);
}

double texel_centre(int index, int count) { return (index + 0.5) / count; }

}  // namespace

ScaleBias integrate_brdf(double cosine, double roughness, Masking masking, HammersleyRange points) {
  const double alpha = roughness * roughness;
  const Direction view = {std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
  ScaleBias sum = {0.0, 0.0};
  const Hammersley set(points.count, points.first, {});
  for (std::uint32_t i = 0; i < points.count; ++i) {
    const SquarePoint u = set.point(i);
    const Direction half = direction_around_z(ggx_half_vector_cosine(alpha, u.t), u.s);
    const Direction light = reflect_about(view, half);
    const double view_half = std::clamp(glm::dot(view, half), 0.0, 1.0);
    if (!(light.z > 0.0)) continue;
    const double weight = geometry(masking, alpha, cosine, light.z) * view_half / (half.z * cosine);
    const double fresnel = std::pow(1.0 - view_half, 5.0);
    sum.scale += (1.0 - fresnel) * weight;
    sum.bias += fresnel * weight;
  }
  return {sum.scale / points.count, sum.bias / points.count};
}

ScaleBias integrate_brdf(double cosine, double roughness, Masking masking) {
  static const BrdfQuadrature quadrature(30, 30);
  ScaleBias result = {0.0, 0.0};
  quadrature.integrate({&cosine, 1}, roughness, masking, {&result, 1});
  return result;
}

Grid<ScaleBias> brdf_map(Extent extent, Masking masking) {
  const BrdfQuadrature quadrature(10, 18);
  std::vector<double> cosines;
  for (int x = 0; x < extent.width; ++x) cosines.push_back(texel_centre(x, extent.width));
  auto map = Grid<ScaleBias>::without_values(extent);
  parallel_for(static_cast<std::size_t>(extent.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    quadrature.integrate(cosines, texel_centre(y, extent.height), masking, map.row(y));
  });
  return map;
}

Grid<ScaleBias> brdf_map(Extent extent, Masking masking, HammersleyRange points) {
  auto map = Grid<ScaleBias>::without_values(extent);
  parallel_for(static_cast<std::size_t>(extent.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < extent.width; ++x) {
      map(x, y) = integrate_brdf(texel_centre(x, extent.width), texel_centre(y, extent.height),
                                 masking, points);
    }
  });
  return map;
}

}  // namespace lightproof
