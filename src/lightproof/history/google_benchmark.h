// Runs from the JSON files of Google Benchmark (--benchmark_out).
#pragma once

#include <filesystem>
#include <string>

#include "lightproof/history/run.h"

namespace lightproof {

/// Reads the run in a file of Google Benchmark; its session is left empty. Machine, compiler, flags
/// and commit come from the context (lightproof_bench puts them there); without a machine, host
/// name and number of CPUs stand for it. A `commit` that is not empty takes the place of the
/// file's.
///
/// Values are CPU times, because waiting for a core is no property of the code; wall-clock times
/// where the benchmark's name ends in /real_time or /manual_time. A benchmark with a counter called
/// "instructions" gives that count instead: its time is that of an emulator; one with a counter
/// called "error" gives that. Counters whose names end in "_error" are kept beside the time.
/// Aggregates are left out. Throws InputError, with the file, the place and the reason.
BenchmarkRun read_google_benchmark(const std::filesystem::path& file,
                                   const std::string& commit = "");

}  // namespace lightproof
