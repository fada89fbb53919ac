// Runs with known differences between them.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/history/run.h"
#include "lightproof/stats/tails.h"

namespace lightproof::test {

inline BenchmarkRun synthetic_run(const std::string& commit, const std::string& session,
                                  std::int64_t started, std::vector<Measurement> measurements) {
  static std::uint64_t digest = 0;
  return {session, started, "machine", "compiler",
          "flags", commit,  ++digest,  std::move(measurements)};
}

/// What differs between the sessions of a test.
struct SessionPlan {
  std::string name = "first";
  std::int64_t started = 0;
  int processes = 15;    ///< of each commit
  double ratio = 1.0;    ///< head / base
  double spread = 0.02;  ///< standard deviation of log time
  std::uint64_t seed = 0;
};

/// "base" and "head", ABBA, one value of "kernel" each.
inline std::vector<BenchmarkRun> synthetic_session(const SessionPlan& plan) {
  const RandomStream stream("history/session", 1, plan.seed);
  std::vector<BenchmarkRun> runs;
  for (int i = 0; i < 2 * plan.processes; ++i) {
    const bool head = i % 4 == 1 || i % 4 == 2;
    const double z = normal_quantile(stream.point(static_cast<std::uint64_t>(i)).s + 0x1p-54);
    const double value = 100.0 * (head ? plan.ratio : 1.0) * std::exp(plan.spread * z);
    runs.push_back(synthetic_run(head ? "head" : "base", plan.name, plan.started + i,
                                 {{"kernel", Metric::nanoseconds, 0, value}}));
  }
  return runs;
}

inline std::vector<BenchmarkRun> operator+(std::vector<BenchmarkRun> runs,
                                           const std::vector<BenchmarkRun>& more) {
  runs.insert(runs.end(), more.begin(), more.end());
  return runs;
}

}  // namespace lightproof::test
