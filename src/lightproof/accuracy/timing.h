// Clocks of measurements.
#pragma once

#include <chrono>
#include <ctime>
#include <utility>

namespace lightproof {

/// Processor time of this thread, in seconds.
inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What `make` returns, and the elapsed time that it took, in seconds.
template <class Make>
auto timed(const Make& make) {
  const auto begin = std::chrono::steady_clock::now();
  auto made = make();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  return std::pair(std::move(made), elapsed.count());
}

}  // namespace lightproof
