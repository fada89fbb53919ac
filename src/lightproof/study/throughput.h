// Throughput figures from Google Benchmark's JSON.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "lightproof/results/throughput_record.h"

namespace lightproof {

/// What samplers cost, and where it was measured.
struct Throughput {
  std::vector<ThroughputRecord> samplers;
  std::vector<TableRecord> tables;
  std::vector<DirectionRecord> directions;
  CacheSizes caches;
  /// When, where and of what it was measured, as the file says; and how many benchmarks met a busy
  /// machine.
  std::string origin;
  std::size_t busy_rows = 0;  ///< benchmarks whose wall time is over kBusyRatio of processor time
  double wall_per_cpu = 1.0;  ///< the largest such ratio of all benchmarks

  static auto fields(auto& measured) {
    return std::tie(measured.samplers, measured.tables, measured.directions, measured.caches,
                    measured.origin, measured.busy_rows, measured.wall_per_cpu);
  }
};

/// The benchmarks of a study, as a pattern of names: one sample at a time on maps from 256x128 to
/// the largest width (16384 takes 8 GB), the tables, in batches, on one size, and directions of
/// every density on the same and, if maps are as large as that, on 8192x4096.
std::string throughput_filter(std::uint64_t largest_width);

/// Where throughput is measured, and kept.
struct ThroughputSource {
  std::filesystem::path program;       ///< the benchmark program
  std::uint64_t largest_width = 8192;  ///< width of the largest map that is measured
  std::filesystem::path cache = {};    ///< folder of what was measured before; empty: none
  bool measure_again = false;          ///< whether what is kept is measured anew
  /// Shared libraries of plug-ins whose directions are timed as well, each time anew.
  std::vector<std::filesystem::path> plugins = {};
};

/// Runs the benchmarks of a study and reads what it measured, which is kept in the cache; or
/// takes what is kept there of the same program, to the last byte, on this machine and up to this
/// width. What was measured on a busy machine is measured again each time, and the better of both
/// is kept. Throws InputError if the program cannot be started or fails, Interrupted if it was
/// interrupted. A plug-in that cannot be timed has no rows, and `origin` says why.
Throughput measure_throughput(const ThroughputSource& source);

/// Reads a file of Google Benchmark: the rows named `sample/SAMPLER/MAP/WxH/random`, as
/// medians over repetitions, and those of the order `fused` that say what a texel's error is; the
/// caches are those of the machine that wrote the file. Throws InputError naming the file if it is
/// not Google Benchmark's JSON, or has none of the first.
Throughput read_throughput(const std::filesystem::path& file);

}  // namespace lightproof
