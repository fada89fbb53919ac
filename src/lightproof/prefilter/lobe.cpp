#include "lightproof/prefilter/lobe.h"

#include <algorithm>
#include <cmath>

#include "lightproof/prefilter/legendre_sums.h"
#include "lightproof/prefilter/lobe_quadrature.h"
#include "lightproof/warp/hemisphere.h"

namespace lightproof {
namespace {

double shape(const PhongLobe& lobe, double cosine) { return cosine_power(cosine, lobe.exponent); }

/// Smith's masking of GGX for one direction.
double masking(double alpha, double cosine) {
  const double tilted = std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine);
  return 2.0 * cosine / (cosine + tilted);
}

/// Schlick's Fresnel reflectance for the half-vector, relative to normal incidence.
double fresnel(double f0, double cosine) {
  const double half = std::sqrt(0.5 * (1.0 + cosine));
  return 1.0 + (1.0 - f0) / f0 * std::pow(1.0 - half, 5.0);
}

/// With cos^2 of the half-vector's angle (1 + c)/2, D falls off as (1 + alpha^2 - (1 - alpha^2) c)
/// to the power of -2; written with 1 - c, in which nothing cancels near the axis.
double shape(const GgxLobe& lobe, double cosine) {
  const double square = lobe.alpha * lobe.alpha;
  const double peak = 2.0 * square / (2.0 * square + (1.0 - square) * (1.0 - cosine));
  const double weight = lobe.weight == GgxWeight::cosine
                            ? cosine
                            : masking(lobe.alpha, cosine) * fresnel(lobe.f0, cosine);
  return peak * peak * weight;
}

double shape(const HalfVectorLobe& lobe, double cosine) {
  const double distribution = std::pow(0.5 * (1.0 + cosine), 0.5 * lobe.shininess);
  switch (lobe.geometry) {
    case GeometryTerm::cosine:
      return distribution * cosine;
    case GeometryTerm::cook_torrance:
      return distribution * std::min(1.0, 2.0 * cosine);
    case GeometryTerm::none:
      break;
  }
  return distribution;
}

double fall_off(const PhongLobe& lobe) { return 1.0 / std::sqrt(lobe.exponent + 1.0); }
double fall_off(const GgxLobe& lobe) { return 2.0 * lobe.alpha; }
double fall_off(const HalfVectorLobe& lobe) { return 2.0 / std::sqrt(lobe.shininess + 1.0); }

}  // namespace

double relative_density(const Lobe& lobe, double cosine) {
  if (!(cosine > 0.0)) return 0.0;
  return std::visit([&](const auto& one) { return shape(one, std::min(cosine, 1.0)); }, lobe);
}

double solid_angle(const Lobe& lobe) {
  if (const auto* phong = std::get_if<PhongLobe>(&lobe)) {
    return 2.0 * kPi / (phong->exponent + 1.0);
  }
  const LobeNodes nodes = lobe_nodes(lobe, 0);
  return legendre_sums(nodes.cosines, nodes.weights, 0).front();
}

Radians width(const Lobe& lobe) {
  return {std::visit([](const auto& one) { return fall_off(one); }, lobe)};
}

std::vector<double> zonal_factors(const PhongLobe& lobe, int degree) {
  const double n = lobe.exponent;
  std::vector<double> factors(static_cast<std::size_t>(degree) + 1);
  for (int l = 0; l <= degree; ++l) {
    const auto at = static_cast<std::size_t>(l);
    if (l == 0) factors[at] = 1.0;
    if (l == 1) factors[at] = (n + 1.0) / (n + 2.0);
    if (l >= 2) factors[at] = factors[at - 2] * (n - l + 2.0) / (n + l + 1.0);
  }
  return factors;
}

std::vector<double> zonal_factors(const Lobe& lobe, int degree) {
  if (const auto* phong = std::get_if<PhongLobe>(&lobe)) return zonal_factors(*phong, degree);
  const LobeNodes nodes = lobe_nodes(lobe, degree);
  std::vector<double> factors = legendre_sums(nodes.cosines, nodes.weights, degree);
  const double whole = factors.front();
  for (double& factor : factors) factor /= whole;
  return factors;
}

}  // namespace lightproof
