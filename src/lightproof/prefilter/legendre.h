// Associated Legendre functions P(l,m), m >= 0, normalised so that over the sphere P(l,0) and
// sqrt(2) P(l,m) cos(m phi) are orthonormal; without the Condon-Shortley phase.
#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "lightproof/core/measure.h"

namespace lightproof {

/// How many there are up to a degree, and where (l,m) stands among them.
constexpr std::size_t legendre_count(int degree) {
  return static_cast<std::size_t>(degree + 1) * static_cast<std::size_t>(degree + 2) / 2;
}
constexpr std::size_t legendre_index(int l, int m) {
  return static_cast<std::size_t>(l) * static_cast<std::size_t>(l + 1) / 2 +
         static_cast<std::size_t>(m);
}

/// All functions up to a degree, by the recurrence upwards in l, which is stable. Where
/// sin(theta)^m is below the smallest double, so that it counts for nothing, they are 0.
class LegendreFunctions {
 public:
  explicit LegendreFunctions(int degree) : degree_(degree) {
    for (int l = 0; l <= degree; ++l) {
      for (int m = 0; m <= l; ++m) factors_.push_back(factors(l, m));
    }
  }

  int degree() const { return degree_; }

  /// At theta with this sine and cosine, to values[legendre_index(l, m)].
  void evaluate(double sine, double cosine, std::span<double> values) const {
    assert(values.size() == factors_.size());
    values[0] = std::sqrt(1.0 / kSphere);
    for (int l = 1; l <= degree_; ++l) {
      for (int m = 0; m <= l; ++m) {
        const std::size_t at = legendre_index(l, m);
        const auto& [previous, before] = factors_[at];
        if (m == l) {
          values[at] = previous * sine * values[legendre_index(l - 1, l - 1)];
          continue;
        }
        values[at] = previous * cosine * values[legendre_index(l - 1, m)];
        if (m < l - 1) values[at] -= before * values[legendre_index(l - 2, m)];
      }
    }
  }

 private:
  /// Of P(l-1,m) cos(theta) and P(l-2,m); for m = l, of P(l-1,l-1) sin(theta).
  struct Factors {
    double previous;
    double before;
  };
  static Factors factors(int l, int m) {
    if (l == 0) return {0.0, 0.0};
    if (m == l) return {std::sqrt((2.0 * l + 1.0) / (2.0 * l)), 0.0};
    const double square = 1.0 * l * l;
    const double lower = (l - 1.0) * (l - 1.0);
    const double previous = std::sqrt((4.0 * square - 1.0) / (square - 1.0 * m * m));
    if (m == l - 1) return {previous, 0.0};
    return {previous, previous * std::sqrt((lower - 1.0 * m * m) / (4.0 * lower - 1.0))};
  }

  int degree_;
  std::vector<Factors> factors_;
};

}  // namespace lightproof
