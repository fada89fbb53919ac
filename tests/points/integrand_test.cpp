// Means and variances of the integrands against a sum over a fine grid.
#include "lightproof/points/integrand.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/core/error.h"

namespace lightproof::test {
namespace {

TEST(Integrands, HaveTheMeansAndVariancesOfASum) {
  constexpr int kCells = 2048;
  for (const Integrand& integrand : integrands()) {
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < kCells; ++i) {
      for (int j = 0; j < kCells; ++j) {
        const double value = integrand.at({(i + 0.5) / kCells, (j + 0.5) / kCells});
        sum += value;
        squares += value * value;
      }
    }
    const double n = static_cast<double>(kCells) * kCells;
    // The midpoint rule: h^2/12 of the second derivatives, at most 8 pi^3 of a map, where all is
    // smooth. An edge crosses at most 4 cells a row, each of which is off by 4 pi at most, and by
    // half of that on average, with signs that cancel to the root of their number.
    const double h = 1.0 / kCells;
    const double smooth = 300.0 * h * h;
    const double edge = 4.0 * kPi * 2.0 * std::sqrt(4.0 * kCells) / n;
    EXPECT_NEAR(sum / n, integrand.mean, smooth + edge) << integrand.name;
    const double scale = 4.0 * kPi;
    EXPECT_NEAR(squares / n - sum / n * sum / n, integrand.variance, 2.0 * scale * (smooth + edge))
        << integrand.name;
  }
}

TEST(Integrands, HaveNamesThatAreFound) {
  for (const Integrand& integrand : integrands()) {
    EXPECT_EQ(&integrand_by_name(integrand.name), &integrand);
  }
  EXPECT_THROW(integrand_by_name("constant"), InputError);
}

}  // namespace
}  // namespace lightproof::test
