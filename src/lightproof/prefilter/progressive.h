// The mean of samples that arrive frame by frame.
//
// A buffer holds the mean a of N samples, and a frame brings the mean b of M more: the mean of all
// is a N/(N+M) + b M/(N+M). Project 004 states the two weights swapped in its text and right in its
// code, as factors of the blending hardware in single precision. All three are here.
#pragma once

#include <cstdint>

namespace lightproof {

/// The mean, in double and with Neumaier's compensation: its error is a rounding, however many
/// samples there are. T is double or a vector of doubles.
template <class T>
class RunningMean {
 public:
  void add(T frame_mean, std::uint64_t samples) {
    const T term = frame_mean * static_cast<double>(samples);
    const T sum = sum_ + term;
    // What the sum lost of the smaller one, exactly, whichever that was (Knuth).
    const T term_kept = sum - sum_;
    lost_ += (sum_ - (sum - term_kept)) + (term - term_kept);
    sum_ = sum;
    count_ += samples;
  }

  /// Adds what another one has of further samples.
  void merge(const RunningMean& other) {
    if (other.count_ == 0) return;
    const std::uint64_t together = count_ + other.count_;
    add(other.sum_, 1);
    lost_ += other.lost_;
    count_ = together;
  }

  std::uint64_t count() const { return count_; }
  /// 0 before the first sample.
  T mean() const { return count_ == 0 ? T(0.0) : (sum_ + lost_) / static_cast<double>(count_); }

 private:
  T sum_ = T(0.0);
  T lost_ = T(0.0);
  std::uint64_t count_ = 0;
};

/// As the published code blends: a (1 - f) + b f with f = M/(N+M), in single precision. Right until
/// f is lost in a; then it stands still.
class PublishedBlend {
 public:
  void add(float frame_mean, std::uint64_t samples) {
    const float factor = static_cast<float>(samples) / static_cast<float>(count_ + samples);
    mean_ = frame_mean * factor + mean_ * (1.0F - factor);
    count_ += samples;
  }
  float mean() const { return mean_; }

 private:
  float mean_ = 0.0F;
  std::uint64_t count_ = 0;
};

/// As the published text has it: a M/(N+M) + b N/(N+M). It never converges: the newest frames keep
/// nearly all of the weight.
class SwappedBlend {
 public:
  void add(double frame_mean, std::uint64_t samples) {
    const auto before = static_cast<double>(count_);
    const auto now = static_cast<double>(samples);
    mean_ = (mean_ * now + frame_mean * before) / (before + now);
    count_ += samples;
  }
  double mean() const { return mean_; }

 private:
  double mean_ = 0.0;
  std::uint64_t count_ = 0;
};

}  // namespace lightproof
