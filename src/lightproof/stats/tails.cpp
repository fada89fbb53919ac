#include "lightproof/stats/tails.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numbers>

namespace lightproof {
namespace {

constexpr double kLn10 = std::numbers::ln10;
/// Below this a double loses digits.
constexpr double kSmallestNormal = 1e-300;

/// log Q(a, x) for x > a + 1 by Legendre's continued fraction, evaluated by Lentz's algorithm
/// (Abramowitz & Stegun 6.5.31).
double log_gamma_q(double a, double x) {
  constexpr double kTiny = 1e-300;
  double b = x + 1.0 - a;
  double c = 1.0 / kTiny;
  double d = 1.0 / b;
  double h = d;
  for (int i = 1; i < 100000; ++i) {
    const double numerator = -i * (i - a);
    b += 2.0;
    d = numerator * d + b;
    d = 1.0 / (std::abs(d) < kTiny ? kTiny : d);
    c = b + numerator / c;
    if (std::abs(c) < kTiny) c = kTiny;
    h *= d * c;
    if (std::abs(d * c - 1.0) < 1e-15) break;
  }
  return -x + a * std::log(x) - boost::math::lgamma(a) + std::log(h);
}

}  // namespace

double log10_chi_square_tail(double statistic, double dof) {
  if (std::isinf(statistic)) return -INFINITY;
  const double a = 0.5 * dof;
  const double x = 0.5 * statistic;
  const double q = boost::math::gamma_q(a, x);
  return q > kSmallestNormal ? std::log10(q) : log_gamma_q(a, x) / kLn10;
}

double log10_chi_square_lower(double statistic, double dof) {
  return std::log10(std::max(boost::math::gamma_p(0.5 * dof, 0.5 * statistic), kSmallestNormal));
}

double log10_poisson_lower(double count, double mean) {
  // P(X <= k) = Q(k + 1, mean).
  return log10_chi_square_tail(2.0 * mean, 2.0 * (count + 1.0));
}

double log10_poisson_upper(double count, double mean) {
  if (count <= 0.0) return 0.0;
  // P(X >= k) = P(k, mean); far out its first term, k log(mean) - mean - log k!, and the ratio of
  // the next ones.
  const double p = boost::math::gamma_p(count, mean);
  if (p > kSmallestNormal) return std::log10(p);
  const double first = count * std::log(mean) - mean - boost::math::lgamma(count + 1.0);
  return (first - std::log1p(-mean / (count + 1.0))) / kLn10;
}

double log10_normal_tails(double z) {
  if (std::isinf(z)) return -INFINITY;
  return log10_chi_square_tail(z * z, 1.0);
}

double detectable_noncentrality(double dof, double alpha, double power) {
  const boost::math::chi_squared central(dof);
  const double critical = boost::math::quantile(boost::math::complement(central, alpha));
  return boost::math::non_central_chi_squared::find_non_centrality(dof, critical, 1.0 - power);
}

double detectable_z(double alpha, double power) {
  const boost::math::normal standard;
  return boost::math::quantile(boost::math::complement(standard, 0.5 * alpha)) +
         boost::math::quantile(standard, power);
}

}  // namespace lightproof
