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

/// Processor time of all threads of this program, in seconds.
inline double process_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What was made, and how long it took.
template <class Made>
struct Timed {
  Made made;
  double elapsed_seconds;
  /// Processor time of all threads of the program: meant for work beside which nothing else runs.
  double processor_seconds;
};

/// What `make` returns, with the time that it took.
template <class Make>
auto timed(const Make& make) {
  const auto begin = std::chrono::steady_clock::now();
  const double processor_begin = process_seconds();
  auto made = make();
  const double processor = process_seconds() - processor_begin;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  return Timed<decltype(made)>{std::move(made), elapsed.count(), processor};
}

}  // namespace lightproof
