#include "lightproof/prefilter/lobe_plan.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lightproof/prefilter/legendre_sums.h"
#include "lightproof/prefilter/lobe_quadrature.h"
#include "lightproof/prefilter/zonal_convolution.h"

namespace lightproof {
namespace {

/// There are at least so many of the factors that fade by a power law.
constexpr int kLeastDegree = 256;

/// The degree at which the factors have fallen below the tolerance, by their asymptotic form:
/// exp(-l^2/2n) of Phong's lobe, exp(-2 l^2/S) of a half-vector's; GGX's is analytic as far as the
/// angle 2i artanh(alpha), so its factors fall off as ((1 - alpha)/(1 + alpha))^l.
double fading_degree(const PhongLobe& lobe, double logarithm) {
  return std::sqrt(2.0 * (lobe.exponent + 1.0) * logarithm);
}
double fading_degree(const GgxLobe& lobe, double logarithm) {
  return logarithm / std::log1p(2.0 * lobe.alpha / std::max(1.0 - lobe.alpha, 1e-9));
}
double fading_degree(const HalfVectorLobe& lobe, double logarithm) {
  return std::sqrt(0.5 * lobe.shininess * logarithm);
}

double power(std::span<const double> factors, std::size_t from) {
  double sum = 0.0;
  for (std::size_t l = from; l < factors.size(); ++l) {
    sum += (2.0 * static_cast<double>(l) + 1.0) * factors[l] * factors[l];
  }
  return sum;
}

/// Whether too much is left out after the last factor, were they to fall off by a power law. Of
/// l^(-3/2), what follows is nine times the last tenth; of faster ones it is less.
bool fades_slowly(std::span<const double> factors) {
  constexpr double kMost = 1e-3;
  return 9.0 * power(factors, factors.size() / 10 * 9) > kMost * kMost * power(factors, 0);
}

/// Drops the last factors that are below the tolerance together.
void trim(std::vector<double>& factors, double whole) {
  double rest = 0.0;
  const double most = kHarmonicsTolerance * kHarmonicsTolerance * whole;
  while (factors.size() > 1) {
    const auto l = static_cast<double>(factors.size() - 1);
    rest += (2.0 * l + 1.0) * factors.back() * factors.back();
    if (rest > most) return;
    factors.pop_back();
  }
}

double cosine_of(double haversine) { return 1.0 - 2.0 * haversine; }

LobePlan sum_whole(const Lobe& lobe) {
  LobePlan plan;
  plan.local =
      ZonalKernel{[lobe](double haversine) { return relative_density(lobe, cosine_of(haversine)); },
                  width(lobe),
                  {0.5 * kPi},
                  true};
  plan.local_share = 1.0;
  return plan;
}

/// A window that falls from 1 on the axis to 0 at `reach`, both to 1e-8.
double window(double angle, double reach) {
  return 0.5 * std::erfc(4.0 * (2.0 * angle / reach - 1.0));
}

/// The factors of what the window leaves, relative to the whole lobe.
std::vector<double> outer_factors(const Lobe& lobe, const LobeNodes& nodes, double reach) {
  std::vector<double> weights = nodes.weights;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] *= 1.0 - window(nodes.angles[i], reach);
  }
  std::vector<double> factors = legendre_sums(nodes.cosines, weights, kLargestDegree);
  const double whole = solid_angle(lobe);
  for (double& factor : factors) factor /= whole;
  return factors;
}

/// The sum of (2l+1) lambda_l^2 over all degrees: 4 pi times the integral of the square.
double whole_power(const Lobe& lobe, const LobeNodes& nodes) {
  double sum = 0.0;
  for (std::size_t i = 0; i < nodes.cosines.size(); ++i) {
    sum += nodes.weights[i] * relative_density(lobe, nodes.cosines[i]);
  }
  const double whole = solid_angle(lobe);
  return kSphere * sum / (whole * whole);
}

LobePlan split(const Lobe& lobe) {
  const LobeNodes nodes = lobe_nodes(lobe, kLargestDegree);
  const double whole = whole_power(lobe, nodes);
  const double most = kHarmonicsTolerance * kHarmonicsTolerance * whole;
  constexpr double kNarrowest = 0.01;  // radians: harmonics cannot follow a narrower window
  constexpr double kWidest = 0.25;
  for (double reach = kNarrowest;; reach *= 1.25) {
    LobePlan plan;
    plan.factors = outer_factors(lobe, nodes, reach);
    if (reach < kWidest && power(plan.factors, plan.factors.size() / 10 * 9) > most) continue;
    plan.local_share = 1.0 - plan.factors.front();
    plan.local =
        ZonalKernel{[lobe, reach](double haversine) {
                      const double angle = 2.0 * std::asin(std::sqrt(haversine));
                      return window(angle, reach) * relative_density(lobe, cosine_of(haversine));
                    },
                    width(lobe),
                    {reach},
                    false};
    trim(plan.factors, whole);
    return plan;
  }
}

/// The share of a lobe that a clamped cosine has, if both reach the horizon with the same slope; 0
/// of a lobe that ends with a jump, or with no slope at all.
double cosine_share(const Lobe& lobe) {
  constexpr double kNear = 1e-6;
  const double slope = relative_density(lobe, kNear) / kNear;
  const double beyond = relative_density(lobe, 2.0 * kNear) / (2.0 * kNear);
  if (!(std::abs(beyond - slope) <= 1e-3 * slope)) return 0.0;
  return slope * kPi / solid_angle(lobe);
}

/// Takes the slope at the horizon out of the factors, if more than a millionth of a sun's light
/// were left out: the root mean square of a clamped cosine's factors beyond N is nearly N^(-3/2).
void leave_slope_to_cosine(const Lobe& lobe, LobePlan& plan) {
  constexpr double kMost = 1e-6;
  const double share = cosine_share(lobe);
  if (share * std::pow(static_cast<double>(plan.factors.size()), -1.5) < kMost) return;
  const std::vector<double> cosine =
      zonal_factors(PhongLobe{1.0}, static_cast<int>(plan.factors.size()) - 1);
  for (std::size_t l = 0; l < cosine.size(); ++l) plan.factors[l] -= share * cosine[l];
  plan.cosine_share = share;
}

}  // namespace

LobePlan plan_lobe(const Lobe& lobe) {
  const double logarithm = std::log(1.0 / kHarmonicsTolerance);
  const double fading =
      std::visit([&](const auto& one) { return fading_degree(one, logarithm); }, lobe);
  if (fading > kLargestDegree) return split(lobe);
  LobePlan plan;
  plan.factors = zonal_factors(lobe, std::max(static_cast<int>(std::ceil(fading)), kLeastDegree));
  if (fades_slowly(plan.factors)) return sum_whole(lobe);
  const double whole = power(plan.factors, 0);
  leave_slope_to_cosine(lobe, plan);
  trim(plan.factors, whole);
  return plan;
}

}  // namespace lightproof
