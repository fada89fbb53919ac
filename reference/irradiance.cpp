#include "reference/irradiance.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <vector>

#include "lightproof/core/measure.h"
#include "lightproof/image/lat_long_texels.h"

namespace lightproof::reference {
namespace {

/// ∫ (a sin + b cos)+ sin d(theta) between two angles in [0, pi].
double along_meridian(double a, double b, double from, double to) {
  const auto integrand = [&](double theta) {
    return std::max(0.0, a * std::sin(theta) + b * std::cos(theta)) * std::sin(theta);
  };
  using Rule = boost::math::quadrature::gauss<double, 30>;
  // a sin + b cos changes its sign once.
  const double root = std::atan2(b, -a);
  const double horizon = std::clamp(root < 0.0 ? root + kPi : root, from, to);
  return Rule::integrate(integrand, from, horizon) + Rule::integrate(integrand, horizon, to);
}

/// The longitudes between two at which a function of them may bend: where the horizon of the normal
/// at longitude `own` crosses one of the parallels, and where it stands upright. All of them in
/// order, with both ends.
std::vector<double> bends(Direction normal, double own, std::initializer_list<double> parallels,
                          double from, double to) {
  std::vector<double> bends = {from, to};
  const double level = std::hypot(normal.x, normal.y);
  const auto add = [&](double azimuth) {
    for (const double around : {own - azimuth, own + azimuth}) {
      for (int turn = -2; turn <= 2; ++turn) {
        const double at = around + 2.0 * kPi * turn;
        if (at > from && at < to) bends.push_back(at);
      }
    }
  };
  add(0.5 * kPi);
  for (const double theta : parallels) {
    const double cosine = -normal.z * std::cos(theta) / (level * std::sin(theta));
    if (std::abs(cosine) <= 1.0) add(std::acos(cosine));
  }
  std::sort(bends.begin(), bends.end());
  return bends;
}

}  // namespace

double clamped_cosine_of_texel(Extent map, int x, int y, Direction normal) {
  const double theta0 = kPi * (map.height - 1 - y) / map.height;
  const double theta1 = kPi * (map.height - y) / map.height;
  const double phi0 = kPi - 2.0 * kPi * (x + 1) / map.width;
  const double phi1 = kPi - 2.0 * kPi * x / map.width;
  const auto meridian = [&](double phi) {
    const double level = normal.x * std::cos(phi) + normal.y * std::sin(phi);
    return along_meridian(level, normal.z, theta0, theta1);
  };
  const double own = std::atan2(normal.y, normal.x);
  const std::vector<double> edges = bends(normal, own, {theta0, theta1}, phi0, phi1);
  // Where the normal is nearly level, the horizon turns within a small angle of a bend.
  thread_local boost::math::quadrature::tanh_sinh<double> rule;  // it keeps tables
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    // The rule runs from 0 on: further out Boost 1.74 may ask for the lower end itself, and then
    // stops in debug builds.
    const auto from_edge = [&](double azimuth) { return meridian(edges[i] + azimuth); };
    sum += rule.integrate(from_edge, 0.0, edges[i + 1] - edges[i], 1e-12);
  }
  return sum;
}

glm::dvec3 irradiance(const EnvironmentMap& map, Direction normal) {
  require_lat_long(map, "irradiance");
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
