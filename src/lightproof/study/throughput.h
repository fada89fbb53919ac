// Throughput figures from Google Benchmark's JSON.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lightproof/results/throughput_record.h"

namespace lightproof {

struct Throughput {
  std::vector<ThroughputRecord> samplers;
  std::vector<TableRecord> tables;
  CacheSizes caches;
};

/// The benchmarks of a study, as a pattern of names: one sample at a time on maps from 256x128 to
/// the largest width (16384 takes 8 GB), and the tables, in batches, on one size.
std::string throughput_filter(std::uint64_t largest_width);

/// Runs these of the benchmark program and reads what it measured. Throws InputError if it cannot
/// be started or fails, Interrupted if it was interrupted.
Throughput measure_throughput(const std::filesystem::path& program, std::uint64_t largest_width);

/// The rows named sample/<sampler>/<map>/<W>x<H>/random of such a file, medians over repetitions,
/// and those of the order `fused` that say what a texel's error is; the caches are those of the
/// machine that wrote the file. Throws InputError naming the file if it is not Google Benchmark's
/// JSON, or has none of the first.
Throughput read_throughput(const std::filesystem::path& file);

}  // namespace lightproof
