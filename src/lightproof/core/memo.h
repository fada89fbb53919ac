// Values of an expensive pure function of a few numbers, kept by its arguments.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>

namespace lightproof {

/// Keeps what a pure function of N numbers returned. Many threads may ask; two that ask for the
/// same arguments at once may both compute the value. Arguments are the same if their bits are, so
/// that NaN is an argument like any other. When `most` values are kept, all of them are forgotten.
template <std::size_t N>
class Memo {
 public:
  using Arguments = std::array<double, N>;

  explicit Memo(std::size_t most = 4096) : most_(most) {}

  /// compute(arguments), or what it returned before.
  template <class Compute>
  double operator()(const Arguments& arguments, const Compute& compute) {
    const auto key = std::bit_cast<std::array<std::uint64_t, N>>(arguments);
    {
      const std::lock_guard lock(mutex_);
      if (const auto kept = values_.find(key); kept != values_.end()) return kept->second;
    }
    const double value = compute(arguments);
    const std::lock_guard lock(mutex_);
    if (values_.size() >= most_) values_.clear();
    values_.emplace(key, value);
    return value;
  }

 private:
  std::size_t most_;
  std::mutex mutex_;
  std::map<std::array<std::uint64_t, N>, double> values_;
};

}  // namespace lightproof
