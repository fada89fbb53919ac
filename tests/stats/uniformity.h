// Whether p-values are uniform: what calibration tests of statistics come down to.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lightproof {

/// Kolmogorov-Smirnov at alpha = 1e-6: P(D > d) <= 2 exp(-2 n d^2) for every n (Massart 1990).
inline void expect_uniform(std::vector<double> log10_p) {
  std::sort(log10_p.begin(), log10_p.end());
  const auto n = static_cast<double>(log10_p.size());
  double distance = 0.0;
  for (std::size_t i = 0; i < log10_p.size(); ++i) {
    const double p = std::pow(10.0, log10_p[i]);
    const auto rank = static_cast<double>(i);
    distance = std::max({distance, p - rank / n, (rank + 1.0) / n - p});
  }
  EXPECT_LT(distance, std::sqrt(std::log(2.0 / 1e-6) / (2.0 * n)));
}

}  // namespace lightproof
