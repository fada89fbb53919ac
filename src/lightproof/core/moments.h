// Running central moments up to the fourth, in double, without storing the samples.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>

#include "lightproof/core/serialise.h"

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

  /// Adds many values, several times as fast as one by one: their moments about their own mean, in
  /// two passes, then merged. The same division into spans gives the same bits.
  void add(std::span<const double> values) {
    if (values.empty()) return;
    Moments block;
    block.count_ = values.size();
    const double count = static_cast<double>(values.size());
    // The first value as a first guess of the mean: what all values share costs no digits.
    const double guess = values[0];
    block.mean_ = guess + sum(values, [guess](double x) { return x - guess; }) / count;
    const auto power_sum = [&](auto power) {
      return sum(values, [&](double x) { return power(x - block.mean_); });
    };
    block.m2_ = power_sum([](double d) { return d * d; });
    block.m3_ = power_sum([](double d) { return d * d * d; });
    block.m4_ = power_sum([](double d) { return d * d * d * d; });
    merge(block);
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

  void write(ValueWriter& writer) const {
    writer.add(count_);
    for (const double value : {mean_, m2_, m3_, m4_}) writer.add(value);
  }
  static Moments read(ValueReader& reader) {
    Moments moments;
    moments.count_ = reader.number();
    for (double* value : {&moments.mean_, &moments.m2_, &moments.m3_, &moments.m4_}) {
      *value = reader.real();
    }
    return moments;
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
  /// The sum of term(value), in lanes of their own, which become vectors.
  template <class Term>
  static double sum(std::span<const double> values, Term term) {
    constexpr std::size_t kLanes = 8;
    std::array<double, kLanes> lanes = {};
    const std::size_t whole = values.size() - values.size() % kLanes;
    for (std::size_t i = 0; i < whole; i += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) lanes[lane] += term(values[i + lane]);
    }
    for (std::size_t i = whole; i < values.size(); ++i) lanes[i - whole] += term(values[i]);
    return std::accumulate(lanes.begin(), lanes.end(), 0.0);
  }

  std::uint64_t count_ = 0;
  double mean_ = 0.0;
  double m2_ = 0.0;  // sums of powers of deviations from the mean
  double m3_ = 0.0;
  double m4_ = 0.0;
};

}  // namespace lightproof
