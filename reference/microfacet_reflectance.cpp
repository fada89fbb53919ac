#include "reference/microfacet_reflectance.h"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

namespace lightproof::reference {
namespace {

using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;

/// Smith's (sqrt(1 + alpha^2 tan^2(theta)) - 1) / 2 of GGX.
double lambda(double alpha, double mu) {
  const double tangent2 = (1.0 - mu * mu) / (mu * mu);
  return 0.5 * (std::sqrt(1.0 + alpha * alpha * tangent2) - 1.0);
}

/// A normal and its two directions, by their cosines.
struct Facet {
  double normal;  ///< n.h
  double view;    ///< n.v
  double light;   ///< n.l
  double half;    ///< v.h = l.h
};

double seen_and_lit(const RoughMirror& mirror, const Facet& at) {
  const double alpha = mirror.normals.parameter;
  switch (mirror.masking) {
    case Masking::smith_karis: {
      const auto g = [k = 0.5 * alpha](double mu) { return mu / (mu * (1.0 - k) + k); };
      return g(at.view) * g(at.light);
    }
    case Masking::smith_separable:
      return 1.0 / ((1.0 + lambda(alpha, at.view)) * (1.0 + lambda(alpha, at.light)));
    case Masking::smith_height_correlated:
      return 1.0 / (1.0 + lambda(alpha, at.view) + lambda(alpha, at.light));
    case Masking::v_grooves:
      return std::min(
          {1.0, 2.0 * at.normal * at.view / at.half, 2.0 * at.normal * at.light / at.half});
  }
  return 0.0;
}

/// The square of the sine of beta is the share of the normals, drawn by D(h) (n.h), that stand
/// steeper than theta: in beta the lobe is equally wide whatever the roughness.
double beta_of(const NormalDistribution& normals, double theta) {
  if (normals.kind == NormalDistribution::Kind::ggx) {
    return std::atan(std::tan(theta) / normals.parameter);
  }
  return std::acos(std::pow(std::cos(theta), 0.5 * (normals.parameter + 2.0)));
}
double theta_of(const NormalDistribution& normals, double beta) {
  if (normals.kind == NormalDistribution::Kind::ggx) {
    return std::atan(normals.parameter * std::tan(beta));
  }
  const double log_cosine = 2.0 * std::log(std::cos(beta)) / (normals.parameter + 2.0);
  return std::asin(std::sqrt(-std::expm1(2.0 * log_cosine)));
}

/// The mean over the azimuths of normals at this angle, of G (v.h) / ((n.v)(n.h)) `factor`, where
/// light is above the surface: on both sides of the view as far as a cosine says.
template <class Factor>
double mean_around(const RoughMirror& mirror, double theta, double mu, const Factor& factor) {
  const double sine_view = std::sqrt((1.0 - mu) * (1.0 + mu));
  const double sine = std::sin(theta);
  const double cosine = std::cos(theta);
  // n.l = 2 (v.h)(n.h) - n.v > 0
  const double least = 0.5 * mu / cosine - mu * cosine;
  const double across = sine_view * sine;
  if (least >= across) return 0.0;
  const double last = least <= -across ? kPi : std::acos(least / across);
  const auto at = [&](double phi) {
    const double half = across * std::cos(phi) + mu * cosine;
    const double light = 2.0 * half * cosine - mu;
    if (!(light > 0.0)) return 0.0;
    const Facet facet = {cosine, mu, light, half};
    return seen_and_lit(mirror, facet) * half / (mu * cosine) * factor(half);
  };
  if (across == 0.0) return at(0.0);
  return Rule::integrate(at, 0.0, last, 5, 1e-8) / kPi;
}

/// Where azimuths begin to be lost, and where the last one is, the integrand goes like a square
/// root: beta is a smooth step of the variable, whose slope is 0 at both ends.
template <class Integrand>
double integral_between_roots(const Integrand& at, double low, double high) {
  return Rule::integrate(
      [&](double w) {
        return at(low + (high - low) * w * w * (3.0 - 2.0 * w)) * (high - low) * 6.0 * w *
               (1.0 - w);
      },
      0.0, 1.0, 6, 1e-7);
}

template <class Factor>
double integral(const RoughMirror& mirror, double mu, const Factor& factor) {
  const double angle = std::atan2(std::sqrt((1.0 - mu) * (1.0 + mu)), mu);
  // Up to the first angle all azimuths reflect above the surface, from the second on none does.
  const double all = beta_of(mirror.normals, 0.5 * (0.5 * kPi - angle));
  const double none = beta_of(mirror.normals, 0.5 * (0.5 * kPi + angle));
  const auto at = [&](double beta) {
    return std::sin(2.0 * beta) * mean_around(mirror, theta_of(mirror.normals, beta), mu, factor);
  };
  double sum = 0.0;
  if (all > 0.0) sum += integral_between_roots(at, 0.0, all);
  if (none > all) sum += integral_between_roots(at, all, none);
  return sum;
}

}  // namespace

SplitSum split_sum(const RoughMirror& mirror, double mu) {
  const auto fifth_power = [](double half) { return std::pow(1.0 - half, 5.0); };
  const double white = integral(mirror, mu, [](double) { return 1.0; });
  const double bias = integral(mirror, mu, fifth_power);
  return {white - bias, bias};
}

}  // namespace lightproof::reference
