#include "lightproof/stats/moment_tests.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightproof/core/memo.h"
#include "lightproof/stats/critical_value.h"
#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

ZTest judge_deviation(double deviation, double standard_error, double scale) {
  const double z = deviation == 0.0 ? 0.0 : deviation / standard_error;
  return {z, log10_normal_tails(z), deviation / scale};
}

}  // namespace

double log10_tails_of_mean(double z, double samples, const ExactMoments& moments) {
  const double normal = log10_normal_tails(z);
  const double skewness = moments.largest_deviation / std::sqrt(moments.variance);
  const double deviation = std::abs(z);
  // Where skewness z^3 / (6 sqrt n) is log 2.
  const double last_normal = std::cbrt(6.0 * std::numbers::ln2 * std::sqrt(samples) / skewness);
  if (skewness == 0.0 || deviation <= last_normal) return normal;
  // 2 exp(-n/r^2 h(r z / sqrt n)) with r = largest deviation / sigma, h(u) = (1+u) log(1+u) - u.
  const double u = skewness * deviation / std::sqrt(samples);
  const double exponent = samples / (skewness * skewness) * ((1.0 + u) * std::log1p(u) - u);
  const double bound = (std::numbers::ln2 - exponent) * std::numbers::log10e;
  // A tail is no longer than one that begins nearer.
  return std::min({0.0, std::max(normal, bound), log10_normal_tails(last_normal)});
}

double minimum_detectable_factor(double level, double power, double samples,
                                 const ExactMoments& moments, double exact) {
  // The samplers of a density share it.
  static Memo<5> memo;
  const double high = memo(
      {level, samples, moments.mean, moments.variance, moments.largest_deviation},
      [&](const auto& /*arguments*/) {
        return critical_value([&](double z) { return log10_tails_of_mean(z, samples, moments); },
                              std::log10(level));
      });
  const double error = std::sqrt(moments.variance / samples) / exact;
  const double least = 1.0 - normal_quantile(power) * error;
  return least > 0.0 ? (1.0 + high * error) / least : HUGE_VAL;
}

ExactMoments moments_of_squares(const ExactMoments& moments, double fourth_central) {
  return {moments.variance, fourth_central - moments.variance * moments.variance,
          moments.largest_deviation * moments.largest_deviation};
}

ExactMoments moments_of_difference(const ExactMoments& first, const ExactMoments& second,
                                   double ratio) {
  return {first.mean, first.variance + ratio * second.variance,
          std::max(first.largest_deviation, ratio * second.largest_deviation)};
}

ZTest mean_test(const Moments& measured, const ExactMoments& exact) {
  const auto n = static_cast<double>(measured.count());
  const double deviation = measured.mean() - exact.mean;
  const double z = deviation == 0.0 ? 0.0 : deviation / std::sqrt(exact.variance / n);
  return {z, log10_tails_of_mean(z, n, exact), deviation / exact.mean};
}

ZTest variance_test(const Moments& measured, const ExactMoments& exact,
                    double exact_fourth_central) {
  const auto n = static_cast<double>(measured.count());
  const double deviation = measured.variance() - exact.variance;
  const ExactMoments squares = moments_of_squares(exact, exact_fourth_central);
  const double z = deviation == 0.0 ? 0.0 : deviation / std::sqrt(squares.variance / n);
  return {z, log10_tails_of_mean(z, n, squares), deviation / exact.variance};
}

ZTest two_mean_test(const Moments& first, const ExactMoments& first_exact, const Moments& second,
                    const ExactMoments& second_exact) {
  const auto n = static_cast<double>(first.count());
  const double ratio = n / static_cast<double>(second.count());
  const double deviation = first.mean() - second.mean();
  const ExactMoments both = moments_of_difference(first_exact, second_exact, ratio);
  const double z = deviation == 0.0 ? 0.0 : deviation / std::sqrt(both.variance / n);
  return {z, log10_tails_of_mean(z, n, both), deviation / second_exact.mean};
}

ZTest welch_test(const Moments& first, const Moments& second) {
  const double error = std::hypot(first.standard_error(), second.standard_error());
  return judge_deviation(first.mean() - second.mean(), error, second.mean());
}

}  // namespace lightproof
