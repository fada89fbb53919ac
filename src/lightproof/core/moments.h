// Running central moments up to the fourth, in double, without storing the samples.
#pragma once

#include <cmath>
#include <cstdint>

namespace lightproof {

/// Count, mean and central moments of what was added. `merge` follows Chan et al. 1979 and
/// Pébay 2008; merging in a fixed order gives the same bits however the work was split.
class Moments {
 public:
  void add(double x) {
    const double before = static_cast<double>(count_++);
    const double n = static_cast<double>(count_);
    const double delta = x - mean_;
    const double dn = delta / n;
    const double term = delta * dn * before;
    mean_ += dn;
    m4_ += term * dn * dn * (n * n - 3.0 * n + 3.0) + 6.0 * dn * dn * m2_ - 4.0 * dn * m3_;
    m3_ += term * dn * (n - 2.0) - 3.0 * dn * m2_;
    m2_ += term;
  }

  void merge(const Moments& other) {
    if (other.count_ == 0) return;
    if (count_ == 0) {
      *this = other;
      return;
    }
    const double na = static_cast<double>(count_);
    const double nb = static_cast<double>(other.count_);
    const double n = na + nb;
    const double d = other.mean_ - mean_;
    const double dn = d / n;
    const double m4 = m4_ + other.m4_ + d * dn * dn * dn * na * nb * (na * na - na * nb + nb * nb) +
                      6.0 * dn * dn * (na * na * other.m2_ + nb * nb * m2_) +
                      4.0 * dn * (na * other.m3_ - nb * m3_);
    const double m3 = m3_ + other.m3_ + d * dn * dn * na * nb * (na - nb) +
                      3.0 * dn * (na * other.m2_ - nb * m2_);
    m2_ += other.m2_ + d * dn * na * nb;
    m3_ = m3;
    m4_ = m4;
    mean_ += dn * nb;
    count_ += other.count_;
  }

  std::uint64_t count() const { return count_; }
  double mean() const { return mean_; }
  /// Unbiased sample variance; 0 below two samples.
  double variance() const { return count_ < 2 ? 0.0 : m2_ / static_cast<double>(count_ - 1); }
  /// Fourth central moment, divided by the count.
  double fourth_central() const { return count_ == 0 ? 0.0 : m4_ / static_cast<double>(count_); }
  double standard_error() const {
    return count_ == 0 ? 0.0 : std::sqrt(variance() / static_cast<double>(count_));
  }

 private:
  std::uint64_t count_ = 0;
  double mean_ = 0.0;
  double m2_ = 0.0;  // sums of powers of deviations from the mean
  double m3_ = 0.0;
  double m4_ = 0.0;
};

}  // namespace lightproof
