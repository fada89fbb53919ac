#include "lightproof/stats/saddle_point.h"

#include <cmath>
#include <numbers>

namespace lightproof {
namespace {

/// From here on the series below is exact to a double: the next term is z^-13 / 156 = 6e-16.
constexpr double kSeriesFrom = 10.0;

double log_root_two_pi() { return 0.5 * std::log(2.0 * std::numbers::pi); }

/// Abramowitz & Stegun 6.1.41.
double stirling_series(double z) {
  const double w = 1.0 / (z * z);
  return (1.0 / 12.0 -
          w * (1.0 / 360.0 -
               w * (1.0 / 1260.0 -
                    w * (1.0 / 1680.0 - w * (1.0 / 1188.0 - w * (691.0 / 360360.0)))))) /
         z;
}

}  // namespace

double stirling_remainder(double z) {
  if (z >= kSeriesFrom) return stirling_series(z);
  // Gamma(z) = Gamma(z + n) / (z (z + 1) ... (z + n - 1)).
  double shifted = z;
  double product = 1.0;
  for (; shifted < kSeriesFrom; shifted += 1.0) product *= shifted;
  const double log_gamma = (shifted - 0.5) * std::log(shifted) - shifted + log_root_two_pi() +
                           stirling_series(shifted) - std::log(product);
  return log_gamma - ((z - 0.5) * std::log(z) - z + log_root_two_pi());
}

double half_deviance(double observed, double expected, double difference) {
  const double sum = observed + expected;
  if (std::abs(difference) >= 0.1 * sum) {
    return observed * std::log(observed / expected) - difference;
  }
  // log(observed / expected) = 2 artanh v = 2 (v + v^3/3 + v^5/5 + ...).
  const double v = difference / sum;
  double power = 2.0 * observed * v;
  double total = difference * v;
  // |v| < 1/10: the terms from v^21 / 21 on are below 1e-17 of the sum.
  for (int odd = 3; odd < 21; odd += 2) {
    power *= v * v;
    total += power / odd;
  }
  return total;
}

}  // namespace lightproof
