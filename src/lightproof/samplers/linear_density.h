// Inversion of densities over [0,1] that are linear, or linear times the sine of an angle that
// grows in proportion: the marginals and conditionals of a bilinear patch. Neither loses precision
// however small an end is, and both are monotone.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lightproof {

/// The position in [0,1] below which lies the share u of a density that is linear from `low` at 0
/// to `high` at 1; neither is negative, one is positive. The root of the quadratic that does not
/// cancel (Heitz 2020, "Can't Invert the CDF?", closed form of a trapezoid).
inline double invert_linear(double low, double high, double u) {
  const double root = std::sqrt((1.0 - u) * low * low + u * high * high);
  const double denominator = low + root;
  return denominator > 0.0 ? std::min(u * (low + high) / denominator, 1.0) : 0.0;
}

/// The density (low + (high - low) q) sin(angle + step q) over q in [0,1], up to a constant, for
/// many pairs of ends. Angles in radian, 0 <= angle, angle + step <= pi/2 + step/2, step <= pi/2.
class LinearTimesSine {
 public:
  LinearTimesSine(double angle, double step) : angle_(angle), step_(step) {}

  /// ∫ of the density from 0 to q. Expanded around the middle of that range, where the sine's even
  /// part meets the mean of the linear factor, and its odd part the slope: no difference of
  /// primitives that would cancel in a narrow row.
  double integral(double low, double high, double q) const {
    const double half = 0.5 * step_ * q;
    const double middle = angle_ + half;
    const double slope = high - low;
    const double even = std::sin(middle) * sine_over(half) * (low + 0.5 * slope * q);
    const double odd = std::cos(middle) * odd_moment(half) * 0.25 * step_ * q * q * slope;
    return q * (even + odd);
  }

  /// The q below which lies the share u: Newton's steps, and bisection where one would leave the
  /// bracket.
  double invert(double low, double high, double u) const {
    const double wanted = u * integral(low, high, 1.0);
    double below = 0.0;
    double above = 1.0;
    double q = first_guess(low, high, u);
    for (int i = 0; i < kMostSteps; ++i) {
      const double excess = integral(low, high, q) - wanted;
      (excess > 0.0 ? above : below) = q;
      const double density = (low + (high - low) * q) * std::sin(angle_ + step_ * q);
      // Without a slope to go by, a step that leaves the bracket.
      const double newton = density > 0.0 ? q - excess / density : below;
      if (std::abs(newton - q) <= kSmallStep * q) return std::clamp(newton, 0.0, 1.0);
      const bool inside = newton > below && newton < above;
      q = inside ? newton : 0.5 * (below + above);
    }
    return q;
  }

 private:
  /// Bisection alone would end by then; three or four steps do.
  static constexpr int kMostSteps = 128;
  /// Newton's error is about the square of its last step.
  static constexpr double kSmallStep = 0x1p-30;

  /// The solution if the product were linear itself; it is not where it is 0 at both ends.
  double first_guess(double low, double high, double u) const {
    const double first = low * std::sin(angle_);
    const double last = high * std::sin(angle_ + step_);
    const double guess = first + last > 0.0 ? invert_linear(first, last, u) : 0.5;
    return std::clamp(guess, 0x1p-60, 1.0 - 0x1p-53);
  }

  /// sum of c[k] (-z^2)^k, from the last term.
  template <std::size_t kTerms>
  static double even_series(const double (&c)[kTerms], double z) {
    double sum = 0.0;
    for (std::size_t k = kTerms; k-- > 0;) sum = c[k] - z * z * sum;
    return sum;
  }

  /// sin(z) / z for |z| <= pi/4: Taylor's series, cut off below 1e-17.
  static double sine_over(double z) {
    constexpr double kTaylor[] = {
        1.0,           1.0 / 6.0,        1.0 / 120.0,        1.0 / 5040.0,
        1.0 / 362880., 1.0 / 39916800.0, 1.0 / 6227020800.0, 1.0 / 1307674368000.0};
    return even_series(kTaylor, z);
  }

  /// (sin(z) - z cos(z)) / z^3 for |z| <= pi/4: the coefficient of (-z^2)^k is 2 (k+1) / (2k+3)!.
  static double odd_moment(double z) {
    constexpr double kTaylor[] = {2.0 / 6.0,           4.0 / 120.0,          6.0 / 5040.0,
                                  8.0 / 362880.0,      10.0 / 39916800.0,    12.0 / 6227020800.0,
                                  14.0 / 1307674368e3, 16.0 / 355687428096e3};
    return even_series(kTaylor, z);
  }

  double angle_;
  double step_;
};

}  // namespace lightproof
