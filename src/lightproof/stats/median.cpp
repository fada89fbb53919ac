#include "lightproof/stats/median.h"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <limits>

namespace lightproof {

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double median_error(std::vector<double> values) {
  if (values.size() < 2) return 0.0;
  std::sort(values.begin(), values.end());
  // About the median, so that what all values share costs no digits.
  const double centre = median(values);
  const auto n = static_cast<double>(values.size());
  // The median of n values drawn with replacement is the i-th of these with the probability that
  // Beta(a, a) gives to ((i-1)/n, i/n).
  const double a = 0.5 * (n + 1.0);
  double mean = 0.0;
  double square = 0.0;
  double below = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double up_to = boost::math::ibeta(a, a, (static_cast<double>(i) + 1.0) / n);
    const double x = values[i] - centre;
    mean += (up_to - below) * x;
    square += (up_to - below) * x * x;
    below = up_to;
  }
  return std::sqrt(std::max(0.0, square - mean * mean));
}

}  // namespace lightproof
