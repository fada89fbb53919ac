// What benchmarks of samplers share: batches of a stream, and the time of what they are compared
// with.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "lightproof/accuracy/timing.h"
#include "lightproof/core/random.h"

namespace lightproof::bench {

/// Samples of one batch.
inline constexpr std::size_t kBatch = 4096;

using Clock = std::chrono::steady_clock;

inline double nanoseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

/// The points of benchmarks that draw their random numbers themselves.
inline const RandomStream& fused_stream() {
  static const RandomStream stream("bench/fused", 1);
  return stream;
}

/// Calls draw(first) for every kBatch points of a stream, or of the pool, on and on. The time of a
/// sample is processor time, so that other work on the machine does not count.
template <class Draw>
void time_batches(benchmark::State& state, const Draw& draw) {
  std::uint64_t first = 0;
  for (int warm = 0; warm < 4; ++warm, first += kBatch) draw(first);
  const double start = thread_seconds();
  for (auto _ : state) {
    draw(first);
    first += kBatch;
  }
  const double samples = static_cast<double>(state.iterations()) * static_cast<double>(kBatch);
  state.counters["ns_per_sample"] = 1e9 * (thread_seconds() - start) / samples;
  state.SetItemsProcessed(static_cast<std::int64_t>(samples));
}

/// Processor time of a sample: the median of five slices of 5 ms.
template <class Draw>
double ns_per_sample(const Draw& draw) {
  static std::uint64_t first = 0;
  std::array<double, 5> slices;
  draw(first);
  for (double& slice : slices) {
    const double start = thread_seconds();
    double seconds = 0.0;
    double samples = 0.0;
    do {
      draw(first += kBatch);
      samples += kBatch;
      seconds = thread_seconds() - start;
    } while (seconds < 5e-3);
    slice = 1e9 * seconds / samples;
  }
  std::ranges::nth_element(slices, slices.begin() + 2);
  return slices[2];
}

}  // namespace lightproof::bench
