#include "lightproof/stats/moment_tests.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

ZTest judge_deviation(double deviation, double standard_error, double scale) {
  const double z = deviation == 0.0 ? 0.0 : deviation / standard_error;
  return {z, log10_normal_tails(z), deviation / scale};
}

}  // namespace

double log10_tails_of_mean(double z, double samples, const ExactLaw& law) {
  const double normal = log10_normal_tails(z);
  const double skewness = law.largest_deviation / std::sqrt(law.variance);
  const double deviation = std::abs(z);
  const double cramer = skewness * deviation * deviation * deviation / (6.0 * std::sqrt(samples));
  if (cramer <= std::numbers::ln2) return normal;
  // 2 exp(-n/r^2 h(r z / sqrt n)) with r = largest deviation / sigma, h(u) = (1+u) log(1+u) - u.
  const double u = skewness * deviation / std::sqrt(samples);
  const double exponent = samples / (skewness * skewness) * ((1.0 + u) * std::log1p(u) - u);
  const double bound = (std::numbers::ln2 - exponent) * std::numbers::log10e;
  return std::min(0.0, std::max(normal, bound));
}

ZTest mean_test(const Moments& measured, const ExactLaw& exact) {
  const auto n = static_cast<double>(measured.count());
  const double deviation = measured.mean() - exact.mean;
  const double z = deviation == 0.0 ? 0.0 : deviation / std::sqrt(exact.variance / n);
  return {z, log10_tails_of_mean(z, n, exact), deviation / exact.mean};
}

ZTest variance_test(const Moments& measured, const ExactLaw& exact, double exact_fourth_central) {
  const auto n = static_cast<double>(measured.count());
  const double deviation = measured.variance() - exact.variance;
  const double spread = exact_fourth_central - exact.variance * exact.variance;
  const double z = deviation == 0.0 ? 0.0 : deviation / std::sqrt(spread / n);
  const ExactLaw squares = {exact.variance, spread,
                            exact.largest_deviation * exact.largest_deviation};
  return {z, log10_tails_of_mean(z, n, squares), deviation / exact.variance};
}

ZTest two_mean_test(const Moments& first, const ExactLaw& first_law, const Moments& second,
                    const ExactLaw& second_law) {
  const auto n = static_cast<double>(first.count());
  const double ratio = n / static_cast<double>(second.count());
  const double deviation = first.mean() - second.mean();
  // One sample of the first and `ratio` of the second, n times.
  const ExactLaw both = {
      first_law.mean, first_law.variance + ratio * second_law.variance,
      std::max(first_law.largest_deviation, ratio * second_law.largest_deviation)};
  const double z = deviation == 0.0 ? 0.0 : deviation / std::sqrt(both.variance / n);
  return {z, log10_tails_of_mean(z, n, both), deviation / second_law.mean};
}

ZTest welch_test(const Moments& first, const Moments& second) {
  const double error = std::hypot(first.standard_error(), second.standard_error());
  return judge_deviation(first.mean() - second.mean(), error, second.mean());
}

}  // namespace lightproof
