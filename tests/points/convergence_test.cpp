// Errors of integrals by point sets: against exact ones where theory gives them, and the rates at
// which they fall.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/core/parallel.h"
#include "lightproof/points/integration_error.h"
#include "lightproof/points/stratified.h"
#include "lightproof/stats/power_law.h"
#include "tests/points/points.h"

namespace lightproof::test {
namespace {

/// In standard errors. Of a normal error beyond that with probability 2e-9; the squares of 4096
/// errors, whose skewness is a chi-square's of one degree of freedom at most, multiply that by
/// e^1.6 (Edgeworth, z^3 skewness/(6 sqrt(N))). For the hundred tests of this file: 1e-6.
constexpr double kZ = 6.0;
constexpr int kSeeds = 4096;

const Integrand& exponential() { return integrand_by_name("exponential"); }

// exp(s + t) is the product of two functions g = exp, whose mean square is this.
const double kMeanOfSquare = std::expm1(2.0) / 2.0;

/// The mean square of g's averages over intervals of length h, which divide [0,1).
double mean_square_of_averages(double h) {
  const double average = std::expm1(h) / h;  // over exp of the interval's begin
  return average * average * h * std::expm1(2.0) / std::expm1(2.0 * h);
}

/// One uniform point in each of N cells: the mean variance inside of a cell, over N.
double variance_of_stratified(std::uint64_t count) {
  const StratifiedPoints set(count, {});
  const double averages = mean_square_of_averages(1.0 / static_cast<double>(set.columns())) *
                          mean_square_of_averages(1.0 / static_cast<double>(set.rows()));
  return (kMeanOfSquare * kMeanOfSquare - averages) / static_cast<double>(count);
}

/// g(x) g(x + d mod 1), integrated over x.
double autocorrelation(double d) {
  return 0.5 * std::exp(d) * std::expm1(2.0 * (1.0 - d)) +
         0.5 * std::exp(d - 1.0) * (std::exp(2.0) - std::exp(2.0 * (1.0 - d)));
}

/// A set shifted by a uniform vector modulo 1: the mean product of the values at two of its points.
double variance_of_shifted(std::string_view set, std::uint64_t count) {
  const std::vector<SquarePoint> points = all_of(set, count);
  const auto apart = [](double a, double b) { return a >= b ? a - b : a - b + 1.0; };
  double sum = 0.0;
  for (const SquarePoint a : points) {
    for (const SquarePoint b : points) {
      sum += autocorrelation(apart(a.s, b.s)) * autocorrelation(apart(a.t, b.t));
    }
  }
  const double n = static_cast<double>(count);
  return sum / (n * n) - exponential().mean * exponential().mean;
}

/// The variance of f over a scrambled (0,m,2)-net (Owen 1997, "Scrambled net variance for integrals
/// of smooth functions"): f's components in Haar's basis over intervals of lengths 2^-a and 2^-b
/// count 0 times where a, b and their details are finer than no elementary interval, twice in
/// products where the two points of a cell lie across, and once beyond. `square(a, b)` is the mean
/// square of f's averages over boxes 2^-a x 2^-b, for a + b <= m + 1.
double variance_of_scrambled_net(int m, double mean_of_squares,
                                 const std::function<double(int, int)>& square) {
  const auto product_component = [&](int a, int b) {
    return square(a + 1, b + 1) - square(a, b + 1) - square(a + 1, b) + square(a, b);
  };
  // What is integrated exactly: the mean, both coordinates up to m, products up to a + b = m - 2.
  double resolved = square(m, 0) + square(0, m) - square(0, 0);
  double doubled = 0.0;
  for (int a = 0; a < m; ++a) {
    for (int b = 0; a + b <= m - 2; ++b) resolved += product_component(a, b);
    doubled += product_component(a, m - 1 - a);
  }
  return (mean_of_squares - resolved + doubled) / std::ldexp(1.0, m);
}

double variance_of_scrambled_exponential(int m) {
  return variance_of_scrambled_net(m, kMeanOfSquare * kMeanOfSquare, [](int a, int b) {
    return mean_square_of_averages(std::ldexp(1.0, -a)) *
           mean_square_of_averages(std::ldexp(1.0, -b));
  });
}

IntegrationError error_of(std::string_view set, const Integrand& integrand, std::uint64_t count,
                          int seeds = kSeeds) {
  return integration_errors(point_set_by_name(set), integrand,
                            {.counts = {count}, .seeds = seeds})[0];
}

void expect_error(const IntegrationError& measured, double variance, double mean) {
  EXPECT_NEAR(measured.rmse, std::sqrt(variance) / mean, kZ * measured.rmse_error)
      << measured.set << ", " << measured.integrand << ", " << measured.points << " points";
  // A test that sees 25 %.
  EXPECT_LT(kZ * measured.rmse_error, 0.25 * measured.rmse);
}

TEST(IndependentPoints, HaveTheErrorOfTheirVariance) {
  for (const std::string_view set : {"philox", "pcg3d"}) {
    for (const Integrand& integrand : integrands()) {
      for (const std::uint64_t count : {1U, 16U, 100U}) {
        const IntegrationError measured = error_of(set, integrand, count);
        const double variance = integrand.variance / static_cast<double>(count);
        expect_error(measured, variance, integrand.mean);
        EXPECT_DOUBLE_EQ(measured.independent, std::sqrt(variance) / integrand.mean);
      }
    }
  }
}

TEST(StratifiedPoints, HaveTheErrorOfTheirCells) {
  for (const std::uint64_t count : {1U, 12U, 97U, 256U}) {
    expect_error(error_of("stratified", exponential(), count), variance_of_stratified(count),
                 exponential().mean);
  }
}

// A lattice or net shifted modulo 1, from its unshifted points alone.
TEST(ShiftedSets, HaveTheErrorOfTheirDifferences) {
  for (const PointSetInfo& info : point_sets()) {
    if (info.kind != PointKind::lattice && info.kind != PointKind::net) continue;
    if (info.name == "sobol") continue;  // is scrambled
    // Small enough that the roundings of floats are small beside the error.
    for (const std::uint64_t count : {10U, 64U}) {
      expect_error(error_of(info.name, exponential(), count), variance_of_shifted(info.name, count),
                   exponential().mean);
    }
  }
}

TEST(ScrambledSobol, HasTheErrorOfOwensGainCoefficients) {
  for (const int m : {0, 1, 2, 4, 6, 8, 10}) {
    expect_error(error_of("sobol", exponential(), std::uint64_t{1} << m),
                 variance_of_scrambled_exponential(m), exponential().mean);
  }
}

/// An integrand's averages over boxes, from its values at the centres of a fine grid: every entry
/// is that of the box whose upper corner it is, summed up.
class BoxAverages {
 public:
  explicit BoxAverages(const Integrand& integrand) : sums_({kCells + 1, kCells + 1}) {
    for (int y = 0; y < kCells; ++y) {
      double row = 0.0;
      for (int x = 0; x < kCells; ++x) {
        row += integrand.at({(x + 0.5) / kCells, (y + 0.5) / kCells});
        sums_(x + 1, y + 1) = sums_(x + 1, y) + row;
      }
    }
  }

  double mean_square(int a, int b) const {
    const int width = kCells >> a;
    const int height = kCells >> b;
    double sum = 0.0;
    for (int y = 0; y < kCells; y += height) {
      for (int x = 0; x < kCells; x += width) {
        const double inside =
            sums_(x + width, y + height) - sums_(x, y + height) - sums_(x + width, y) + sums_(x, y);
        const double average = inside / (static_cast<double>(width) * height);
        sum += average * average;
      }
    }
    return std::ldexp(sum, -a - b);
  }

 private:
  static constexpr int kCells = 2048;
  Grid<double> sums_;
};

// The averages of boxes that an edge crosses are off by a thousandth, and so is the variance.
TEST(ScrambledSobol, HasTheErrorOfOwensGainCoefficientsAtKinksAndEdgesToo) {
  for (const Integrand& integrand : integrands()) {
    const BoxAverages averages(integrand);
    for (const int m : {4, 6, 8}) {
      const double variance =
          variance_of_scrambled_net(m, integrand.variance + integrand.mean * integrand.mean,
                                    [&](int a, int b) { return averages.mean_square(a, b); });
      expect_error(error_of("sobol", integrand, std::uint64_t{1} << m), variance, integrand.mean);
    }
  }
}

PowerLaw fitted(std::string_view set, const Integrand& integrand) {
  std::vector<PowerLawPoint> points;
  for (const IntegrationError& row :
       integration_errors(point_set_by_name(set), integrand,
                          {.counts = {64, 256, 1024, 4096, 16384}, .seeds = 256})) {
    points.push_back({static_cast<double>(row.points), row.rmse, row.rmse_error / row.rmse});
  }
  return fit_power_law(points);
}

/// By how much the slope through five points, each four times as many as the one before, changes at
/// most if the error's constant stays within a factor of sqrt(2): 2^(±1/4) with the weights' signs,
/// which are -2 … 2 over 10 ln 4. As many boxes as an edge crosses depend on how it lies to them.
const double kFromConstant = 6.0 / (10.0 * std::log(4.0)) * 0.25 * std::log(2.0);

void expect_exponent(std::string_view set, const Integrand& integrand, double expected,
                     double systematic) {
  const PowerLaw fit = fitted(set, integrand);
  EXPECT_NEAR(fit.exponent, expected, systematic + kZ * fit.exponent_error)
      << set << " on " << integrand.name;
}

TEST(Convergence, OfIndependentPointsIsMinusOneHalf) {
  for (const std::string_view set : {"philox", "pcg3d"}) {
    for (const Integrand& integrand : integrands()) expect_exponent(set, integrand, -0.5, 0.0);
  }
}

TEST(Convergence, OfStratifiedPointsIsMinusOneAndMinusThreeQuartersAtEdges) {
  for (const Integrand& integrand : integrands()) {
    const bool edge = integrand.roughness == Roughness::edge;
    expect_exponent("stratified", integrand, edge ? -0.75 : -1.0, kFromConstant);
  }
}

TEST(Convergence, OfScrambledSobolIsMinusThreeHalvesAndLessAtKinksAndEdges) {
  for (const Integrand& integrand : integrands()) {
    switch (integrand.roughness) {
      case Roughness::smooth:
        // The variance has a factor of log N at most: the slope of its root at N is 1/(2 ln N)
        // less.
        expect_exponent("sobol", integrand, -1.5, 0.5 / std::log(64.0));
        break;
      case Roughness::kink:
        expect_exponent("sobol", integrand, -1.25, kFromConstant);
        break;
      case Roughness::edge:
        expect_exponent("sobol", integrand, -0.75, kFromConstant);
        break;
    }
  }
}

// The residual of averages over N^(1/2) x N^(1/2) boxes bounds the variance (Owen: gains are at
// most 2), and the arc crosses fewer than 2 N^(1/2) of them, in each of which it is at most 1/4.
TEST(Convergence, OfScrambledSobolAtAnEdgeStaysBelowItsBound) {
  const Integrand& disc = integrand_by_name("quarter disc");
  for (const std::uint64_t count : {16U, 256U, 4096U}) {
    const IntegrationError measured = error_of("sobol", disc, count, 256);
    EXPECT_LT(measured.rmse * disc.mean, std::pow(static_cast<double>(count), -0.75));
    EXPECT_LT(measured.rmse, measured.independent);
  }
}

// Shifted lattices and Hammersley's points: no theorem gives their rate at edges, but all fall
// faster than random points everywhere.
TEST(Convergence, OfLatticesIsFasterThanThatOfRandomPoints) {
  for (const std::string_view set :
       {"hammersley", "hammersley from 1", "golden", "silver", "bronze", "R2"}) {
    for (const Integrand& integrand : integrands()) {
      const PowerLaw fit = fitted(set, integrand);
      EXPECT_LT(fit.exponent + kZ * fit.exponent_error, -0.6) << set << " on " << integrand.name;
    }
  }
}

TEST(IntegrationErrors, DependOnTheSeedAndNotOnThreads) {
  const PointSetInfo& set = point_set_by_name("sobol");
  const IntegrationOptions options = {.counts = {16, 64}, .seeds = 32};
  const auto rmse = [&](const IntegrationOptions& with) {
    return integration_errors(set, exponential(), with)[1].rmse;
  };
  const double many = rmse(options);
  IntegrationOptions other = options;
  other.seed = 2;
  EXPECT_NE(rmse(other), many);
  const ThreadLimit one(1);
  EXPECT_EQ(rmse(options), many);
}

}  // namespace
}  // namespace lightproof::test
