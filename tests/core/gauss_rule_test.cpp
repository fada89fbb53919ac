#include "lightproof/core/gauss_rule.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightproof {
namespace {

constexpr double kLow = -0.25;
constexpr double kHigh = 1.5;

double power_integral(int n) { return (std::pow(kHigh, n + 1) - std::pow(kLow, n + 1)) / (n + 1); }

template <class Rule>
double power_by(const Rule& rule, int n) {
  return rule.integrate(kLow, kHigh, [n](double x) { return std::pow(x, n); });
}

/// Sums of a few terms below 10.
constexpr double kRounding = 1e-14;

/// What a rule of m nodes leaves of x^(2m) (Abramowitz & Stegun 25.4.30):
/// (m!)^4 / ((2m+1) ((2m)!)^2) h^(2m+1).
double error_of(int m) {
  const double h = kHigh - kLow;
  return std::pow(std::tgamma(m + 1.0), 4) / ((2 * m + 1) * std::pow(std::tgamma(2 * m + 1.0), 2)) *
         std::pow(h, 2 * m + 1);
}

template <class Rule>
class GaussRuleOf : public testing::Test {};
using Rules = testing::Types<GaussRule<2>, GaussRule<3>>;
TYPED_TEST_SUITE(GaussRuleOf, Rules);

TYPED_TEST(GaussRuleOf, IsExactUpToItsDegreeAndOffByTheKnownErrorInTheNext) {
  const TypeParam rule;
  const int nodes = static_cast<int>(rule.nodes().size());
  for (int n = 0; n < 2 * nodes; ++n) {
    EXPECT_NEAR(power_by(rule, n), power_integral(n), kRounding) << n;
  }
  EXPECT_NEAR(power_integral(2 * nodes) - power_by(rule, 2 * nodes), error_of(nodes), kRounding);
}

TYPED_TEST(GaussRuleOf, HasNodesThatAscendInsideTheInterval) {
  const TypeParam rule;
  double before = 0.0;
  double sum = 0.0;
  for (const GaussNode& node : rule.nodes()) {
    EXPECT_GT(node.at, before);
    EXPECT_LT(node.at, 1.0);
    before = node.at;
    sum += node.weight;
  }
  EXPECT_NEAR(sum, 1.0, 1e-15);
}

}  // namespace
}  // namespace lightproof
