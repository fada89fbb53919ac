// What one process of a benchmark program measured, and where.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lightproof {

/// What is measured.
enum class Metric {
  nanoseconds,   ///< CPU time of one iteration
  instructions,  ///< instructions that a kernel of fixed work executes
  error,         ///< how far a result is off, which depends on seeds alone
};

/// Whether a metric has the same value every time, so that there is nothing to test.
constexpr bool is_exact(Metric metric) { return metric != Metric::nanoseconds; }

/// The unit of a metric: "ns", "instructions", "error".
const char* to_string(Metric metric);

/// One value of one repetition.
struct Measurement {
  std::string benchmark;
  Metric metric = Metric::nanoseconds;
  int repetition = 0;
  double value = 0.0;  ///< positive
};

/// What one process measured. The repetitions in a process share its memory layout and its moment,
/// so they are no independent values: whoever compares takes the process as one.
struct BenchmarkRun {
  std::string session;       ///< runs of a session are interleaved, and may be compared
  std::int64_t started = 0;  ///< seconds since 1970, UTC
  std::string machine;
  std::string compiler;
  std::string flags;
  std::string commit;
  std::uint64_t digest = 0;  ///< digest of the file that the run came from
  std::vector<Measurement> measurements;
};

}  // namespace lightproof
