// How even point sets are: errors of integrals and their rates, discrepancies, and what is left of
// those that are computed in float.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace lightproof {

/// The error of an integral over so many points, relative to the integral.
struct PointError {
  std::uint64_t points = 0;
  double rmse = 0.0;         ///< root mean square over the seeds
  double rmse_error = 0.0;   ///< its standard error, from the scatter of the squares
  double independent = 0.0;  ///< the exact error of as many independent points

  static auto fields(auto& r) { return std::tie(r.points, r.rmse, r.rmse_error, r.independent); }
};

/// How fast the error of a point set falls on one integrand.
struct PointRate {
  std::string set;
  std::string kind;       ///< "random", "hash", "stratified", "lattice", "net"
  std::string integrand;  ///< "half-lit map"
  std::string roughness;  ///< of the integrand: "smooth", "kink", "edge"
  int seeds = 0;          ///< independent estimates of each error
  std::vector<PointError> errors;
  /// The exponent of the power law through the errors; NaN if they do not allow for one.
  double exponent = 0.0;
  /// Its standard error, from the errors' own or, where that is larger, from their scatter about
  /// the power law.
  double exponent_error = 0.0;

  static auto fields(auto& r) {
    return std::tie(r.set, r.kind, r.integrand, r.roughness, r.seeds, r.errors, r.exponent,
                    r.exponent_error);
  }
};

/// The discrepancy of the set of so many points, or of the first ones of a set without end.
struct PointDiscrepancy {
  std::string set;
  std::string kind;
  std::uint64_t points = 0;
  double star = 0.0;            ///< largest difference between a box's share of points and its area
  double l2_star = 0.0;         ///< root mean square of these differences
  double independent_l2 = 0.0;  ///< the same of independent points, over all of them

  static auto fields(auto& r) {
    return std::tie(r.set, r.kind, r.points, r.star, r.l2_star, r.independent_l2);
  }
};

/// What is left, of a set that is computed in float, over the points first, first + 1, … of a
/// window.
struct PointDecay {
  std::string set;
  std::uint64_t first = 0;
  std::uint64_t window = 0;    ///< number of points
  std::uint64_t distinct = 0;  ///< different points
  std::uint64_t distinct_s = 0;
  std::uint64_t distinct_t = 0;
  double error_s = 0.0;  ///< largest distance to the exact s, on the circle [0,1)
  double error_t = 0.0;

  static auto fields(auto& r) {
    return std::tie(r.set, r.first, r.window, r.distinct, r.distinct_s, r.distinct_t, r.error_s,
                    r.error_t);
  }
};

struct PointStudy {
  std::vector<PointRate> rates;
  std::vector<PointDiscrepancy> discrepancies;
  std::vector<PointDecay> decay;

  static auto fields(auto& r) { return std::tie(r.rates, r.discrepancies, r.decay); }
};

}  // namespace lightproof
