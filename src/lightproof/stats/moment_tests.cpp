#include "lightproof/stats/moment_tests.h"

#include <cmath>

#include "lightproof/stats/tails.h"

namespace lightproof {
namespace {

ZTest judge_deviation(double deviation, double standard_error, double scale) {
  const double z = deviation == 0.0 ? 0.0 : deviation / standard_error;
  return {z, log10_normal_tails(z), deviation / scale};
}

}  // namespace

ZTest mean_test(const Moments& measured, double expected_mean, double exact_variance) {
  const double error = std::sqrt(exact_variance / static_cast<double>(measured.count()));
  return judge_deviation(measured.mean() - expected_mean, error, expected_mean);
}

ZTest variance_test(const Moments& measured, double exact_variance, double exact_fourth_central) {
  const double error = std::sqrt((exact_fourth_central - exact_variance * exact_variance) /
                                 static_cast<double>(measured.count()));
  return judge_deviation(measured.variance() - exact_variance, error, exact_variance);
}

ZTest welch_test(const Moments& first, const Moments& second) {
  const double error = std::hypot(first.standard_error(), second.standard_error());
  return judge_deviation(first.mean() - second.mean(), error, second.mean());
}

}  // namespace lightproof
