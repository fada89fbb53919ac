// Google Benchmark's reporters, whose rows say how busy the machine was.
#pragma once

#include <benchmark/benchmark.h>

#include <memory>

namespace lightproof::bench {

/// The reporter that the command line asks for. Every row has the counter `wall_per_cpu`, the ratio
/// of wall time to the measuring thread's processor time, and the label "machine busy" where that
/// exceeds kBusyRatio.
std::unique_ptr<benchmark::BenchmarkReporter> display_reporter();

/// The reporter of --benchmark_out, as JSON, with the same rows.
std::unique_ptr<benchmark::BenchmarkReporter> file_reporter();

}  // namespace lightproof::bench
