#include "lightproof/stats/tails.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/tools/fraction.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "lightproof/core/memo.h"
#include "lightproof/stats/saddle_point.h"

namespace lightproof {
namespace {

/// The distribution in double all through: Boost's sums in long double, which it takes unless told
/// otherwise, were a seventh of the time of a calibration, for digits that no effect is printed
/// with.
using NonCentral = boost::math::non_central_chi_squared_distribution<
    double, boost::math::policies::policy<boost::math::policies::promote_double<false>>>;

constexpr double kLn10 = std::numbers::ln10;
/// Below this a double loses digits.
constexpr double kSmallestNormal = 1e-300;

/// log of x^a e^-x / Gamma(a + 1).
double log_gamma_density(double a, double x) {
  return -half_deviance(a, x) - stirling_remainder(a) - 0.5 * std::log(2.0 * std::numbers::pi * a);
}

/// Partial numerators and denominators of Legendre's continued fraction, whose sum with x + 1 - a
/// is x^a e^-x / (Gamma(a) Q(a, x)) (Abramowitz & Stegun 6.5.31, contracted to every other term).
struct LegendreFraction {
  using result_type = std::pair<double, double>;

  result_type operator()() {
    ++k;
    return {k * (a - k), x + 1.0 - a + 2.0 * k};
  }

  double a;
  double x;
  int k = 0;
};

/// log Q(a, x) for x > a + 1. Where Q is below a double, (x - a)^2 > 37^2 a, the fraction converges
/// in ten steps, whatever a.
double log_gamma_q(double a, double x) {
  LegendreFraction fraction{a, x};
  const double rest = boost::math::tools::continued_fraction_a(fraction, 1e-15);
  return log_gamma_density(a, x) + std::log(a / (x + 1.0 - a + rest));
}

/// log P(a, x) for x < a by its series (Abramowitz & Stegun 6.5.29), whose terms fall like
/// (x / a)^n.
double log_gamma_p(double a, double x) {
  double term = 1.0;
  double sum = 1.0;
  for (double k = a + 1.0; term > 1e-17 * sum; k += 1.0) {
    term *= x / k;
    sum += term;
  }
  return log_gamma_density(a, x) + std::log(sum);
}

/// Whether P(a, x) is surely below 1e-80, so that Q(a, x) is 1: near x = 0 Boost would take
/// Gamma(a) itself, which is no double from a = 1755 on.
bool is_far_below(double a, double x) { return a > 1000.0 && x < 0.5 * a; }

/// log10 P(a, x).
double log10_gamma_p(double a, double x) {
  if (x <= 0.0) return -INFINITY;
  if (std::isinf(x)) return 0.0;
  if (is_far_below(a, x)) return log_gamma_p(a, x) / kLn10;
  const double p = boost::math::gamma_p(a, x);
  return p > kSmallestNormal ? std::log10(p) : log_gamma_p(a, x) / kLn10;
}

}  // namespace

double log10_chi_square_tail(double statistic, double dof) {
  if (std::isnan(statistic)) return statistic;
  if (std::isinf(statistic)) return -INFINITY;
  const double a = 0.5 * dof;
  const double x = std::max(0.0, 0.5 * statistic);
  if (is_far_below(a, x)) return 0.0;
  const double q = boost::math::gamma_q(a, x);
  return q > kSmallestNormal ? std::log10(q) : log_gamma_q(a, x) / kLn10;
}

double log10_chi_square_lower(double statistic, double dof) {
  if (std::isnan(statistic)) return statistic;
  return log10_gamma_p(0.5 * dof, 0.5 * statistic);
}

double log10_poisson_lower(double count, double mean) {
  // P(X <= k) = Q(k + 1, mean).
  return log10_chi_square_tail(2.0 * mean, 2.0 * (count + 1.0));
}

double log10_poisson_upper(double count, double mean) {
  // P(X >= k) = P(k, mean).
  return count <= 0.0 ? 0.0 : log10_gamma_p(count, mean);
}

double poisson_mean_reaching(double count, double probability) {
  // P(X >= k) = P(k, mean).
  return boost::math::gamma_p_inv(count, probability);
}

double log10_normal_tails(double z) {
  if (std::isinf(z)) return -INFINITY;
  return log10_chi_square_tail(z * z, 1.0);
}

double minimum_detectable_noncentrality(double dof, double alpha, double power) {
  // The tests of many runs share few of these, and each takes some hundred microseconds.
  static Memo<3> memo;
  return memo({dof, alpha, power}, [&](const auto& /*argument*/) {
    const boost::math::chi_squared central(dof);
    return noncentrality_beyond(dof, boost::math::quantile(boost::math::complement(central, alpha)),
                                power);
  });
}

double noncentrality_beyond(double dof, double critical, double probability) {
  return NonCentral::find_non_centrality(dof, critical, 1.0 - probability);
}

double chi_square_power(double dof, double alpha, double noncentrality) {
  const boost::math::chi_squared central(dof);
  const double critical = boost::math::quantile(boost::math::complement(central, alpha));
  if (noncentrality <= 0.0) return alpha;
  const NonCentral shifted(dof, noncentrality);
  return boost::math::cdf(boost::math::complement(shifted, critical));
}

double normal_cdf(double z) { return boost::math::cdf(boost::math::normal(), z); }

double normal_quantile(double probability) {
  return boost::math::quantile(boost::math::normal(), probability);
}

double student_upper(double t, double dof) {
  return boost::math::cdf(boost::math::complement(boost::math::students_t(dof), t));
}

double minimum_detectable_z(double alpha, double power) {
  const boost::math::normal standard;
  return boost::math::quantile(boost::math::complement(standard, 0.5 * alpha)) +
         boost::math::quantile(standard, power);
}

}  // namespace lightproof
