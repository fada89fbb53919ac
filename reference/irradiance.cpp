#include "reference/irradiance.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "lightproof/core/measure.h"

namespace lightproof::reference {
namespace {

/// ∫ (a sin + b cos)+ sin d(theta) between two angles in [0, pi].
double along_meridian(double a, double b, double from, double to) {
  const auto integrand = [&](double theta) {
    return std::max(0.0, a * std::sin(theta) + b * std::cos(theta)) * std::sin(theta);
  };
  // a sin + b cos changes its sign once.
  const double root = std::atan2(b, -a);
  const double horizon = std::clamp(root < 0.0 ? root + kPi : root, from, to);
  using Rule = boost::math::quadrature::gauss<double, 30>;
  return Rule::integrate(integrand, from, horizon) + Rule::integrate(integrand, horizon, to);
}

}  // namespace

double clamped_cosine_of_texel(Extent map, int x, int y, Direction normal) {
  const double from = kPi * (map.height - 1 - y) / map.height;
  const double to = kPi * (map.height - y) / map.height;
  const auto meridian = [&](double s) {
    const double phi = kPi - 2.0 * kPi * s;
    const double level = normal.x * std::cos(phi) + normal.y * std::sin(phi);
    return 2.0 * kPi * along_meridian(level, normal.z, from, to);
  };
  constexpr int kDepth = 20;
  constexpr double kTolerance = 1e-14;
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
  return Rule::integrate(meridian, static_cast<double>(x) / map.width,
                         static_cast<double>(x + 1) / map.width, kDepth, kTolerance);
}

glm::dvec3 irradiance(const EnvironmentMap& map, Direction normal) {
  const Extent extent = map.radiance.extent();
  glm::dvec3 sum(0.0);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      sum += clamped_cosine_of_texel(extent, x, y, normal) * glm::dvec3(map.radiance(x, y));
    }
  }
  return sum;
}

}  // namespace lightproof::reference
