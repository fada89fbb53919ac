#include "lightproof/prefilter/brdf_quadrature.h"

#include <algorithm>
#include <array>
#include <boost/math/special_functions/legendre.hpp>
#include <cmath>

#include "lightproof/core/measure.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lightproof/prefilter/brdf_quadrature.cpp"
#include <hwy/foreach_target.h>
// Highway asks for this order.
#include <hwy/highway.h>

#ifndef LIGHTPROOF_PREFILTER_BRDF_QUADRATURE_BLOCK
#define LIGHTPROOF_PREFILTER_BRDF_QUADRATURE_BLOCK
namespace lightproof {

/// View angles that go through the nodes together.
constexpr std::size_t kViews = 64;

/// What a node has to know of each view, and what it adds to.
struct BrdfViews {
  std::array<double, kViews> cosine;
  std::array<double, kViews> sine;
  std::array<double, kViews> root;   ///< sqrt(alpha^2 + (1 - alpha^2) cosine^2)
  std::array<double, kViews> least;  ///< w_0 on the meridian
  std::array<double, kViews> scale;
  std::array<double, kViews> bias;
};

/// One node of one meridian.
struct BrdfNode {
  double azimuth_cosine;
  double position;
  double weight;
};

}  // namespace lightproof
#endif

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {
namespace {

/// A plain loop, which the compiler makes vectors of.
///
/// With h at chi, q = sqrt(w^2 + alpha^2 (1 - w^2)), w = cos(chi): cos(theta_h) = w/q and
/// sin(theta_h) = alpha sqrt(1 - w^2)/q; D cos(theta_h) d(omega_h) = 2 w dw d(phi)/2pi, and the
/// weight G v·h/(n·v n·h) makes 2 q v·h G/(n·v) dw of it, in which nothing diverges.
template <class Geometry>
HWY_INLINE void add_node(const BrdfNode& node, double alpha, const Geometry& geometry,
                         BrdfViews& views) {
  const double square = alpha * alpha;
  for (std::size_t i = 0; i < kViews; ++i) {
    const double mu = views.cosine[i];
    const double w = views.least[i] + (1.0 - views.least[i]) * node.position;
    const double rest = (1.0 - w) * (1.0 + w);
    const double q = std::sqrt(w * w + square * rest);
    const double up = w / q;
    const double side = alpha * std::sqrt(rest) / q;
    const double vh = views.sine[i] * node.azimuth_cosine * side + mu * up;
    const double light = std::max(0.0, 2.0 * vh * up - mu);
    const double weight =
        node.weight * (1.0 - views.least[i]) * 2.0 * q * vh *
        geometry(mu, views.root[i], light, std::sqrt(square + (1.0 - square) * light * light));
    const double miss = 1.0 - vh;
    const double fresnel = miss * miss * miss * miss * miss;
    views.scale[i] += weight * (1.0 - fresnel);
    views.bias[i] += weight * fresnel;
  }
}

/// G/(n·v), of the cosines to view and light and their roots.
void add_brdf_node(const BrdfNode& node, double alpha, Masking masking, BrdfViews& views) {
  switch (masking) {
    case Masking::karis: {
      const double k = 0.5 * alpha;
      return add_node(
          node, alpha,
          [k](double mu, double, double light, double) {
            return light / ((mu * (1.0 - k) + k) * (light * (1.0 - k) + k));
          },
          views);
    }
    case Masking::separable:
      return add_node(
          node, alpha,
          [](double mu, double root, double light, double light_root) {
            return 4.0 * light / ((mu + root) * (light + light_root));
          },
          views);
    case Masking::height_correlated:
      return add_node(
          node, alpha,
          [](double mu, double root, double light, double light_root) {
            return 2.0 * light / (mu * light_root + light * root);
          },
          views);
  }
}

}  // namespace
}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lightproof {
namespace {

HWY_EXPORT(add_brdf_node);

/// A cosine of 0 makes 0/0 of what has a limit.
constexpr double kLeastCosine = 1e-12;

struct LegendreRule {
  std::vector<double> positions;  ///< in (0,1)
  std::vector<double> weights;
};

LegendreRule legendre_rule(int nodes) {
  LegendreRule rule;
  for (const double zero : boost::math::legendre_p_zeros<double>(nodes)) {
    const double slope = boost::math::legendre_p_prime(nodes, zero);
    const double weight = 1.0 / ((1.0 - zero * zero) * slope * slope);
    for (const double x : {-zero, zero}) {
      if (x == 0.0 && !rule.positions.empty())
        continue;  // of an odd number, the middle one comes first
      rule.positions.push_back(0.5 * (1.0 + x));
      rule.weights.push_back(weight);
    }
  }
  return rule;
}

/// Sets for each view the w = cos(chi) at which the light on this meridian sets: tan(theta_h) = (s
/// cos(phi) + sqrt(s^2 cos^2(phi) + mu^2))/mu, s the sine to the view.
void set_least(BrdfViews& views, double azimuth_cosine, double alpha) {
  for (std::size_t i = 0; i < kViews; ++i) {
    const double mu = views.cosine[i];
    const double across = views.sine[i] * azimuth_cosine;
    const double root = std::sqrt(across * across + mu * mu);
    const double opposite = across >= 0.0 ? across + root : mu;
    const double adjacent = alpha * (across >= 0.0 ? mu : root - across);
    views.least[i] = adjacent / std::sqrt(adjacent * adjacent + opposite * opposite);
  }
}

BrdfViews views_at(std::span<const double> cosines, double alpha) {
  BrdfViews views = {};
  for (std::size_t i = 0; i < kViews; ++i) {
    const double cosine = std::max(kLeastCosine, cosines[std::min(i, cosines.size() - 1)]);
    views.cosine[i] = cosine;
    views.sine[i] = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    views.root[i] = std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine);
  }
  return views;
}

}  // namespace

BrdfQuadrature::BrdfQuadrature(int around, int along) {
  const LegendreRule azimuth = legendre_rule(around);
  for (const double quarter : {0.0, 0.5 * kPi}) {
    for (std::size_t i = 0; i < azimuth.positions.size(); ++i) {
      // Half of the circle, of which the other half is the mirror image: 2 (pi/2)/2pi.
      around_.push_back(
          {std::cos(quarter + 0.5 * kPi * azimuth.positions[i]), 0.5 * azimuth.weights[i]});
    }
  }
  const LegendreRule meridian = legendre_rule(along);
  for (std::size_t i = 0; i < meridian.positions.size(); ++i) {
    const double x = meridian.positions[i];
    along_.push_back({x * x * x * (4.0 - 3.0 * x), 12.0 * x * x * (1.0 - x) * meridian.weights[i]});
  }
}

void BrdfQuadrature::integrate(std::span<const double> cosines, double roughness, Masking masking,
                               std::span<ScaleBias> results) const {
  const double alpha = roughness * roughness;
  for (std::size_t begin = 0; begin < cosines.size(); begin += kViews) {
    BrdfViews views = views_at(cosines.subspan(begin), alpha);
    for (const Node& azimuth : around_) {
      set_least(views, azimuth.position, alpha);
      for (const Node& meridian : along_) {
        HWY_DYNAMIC_DISPATCH(add_brdf_node)
        ({azimuth.position, meridian.position, azimuth.weight * meridian.weight}, alpha, masking,
         views);
      }
    }
    for (std::size_t i = 0; i < std::min(kViews, cosines.size() - begin); ++i) {
      results[begin + i] = {views.scale[i], views.bias[i]};
    }
  }
}

}  // namespace lightproof
#endif
