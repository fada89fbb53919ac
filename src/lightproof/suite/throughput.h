// Throughput figures from Google Benchmark's JSON.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "lightproof/suite/results.h"

namespace lightproof {

struct Throughput {
  std::vector<ThroughputRecord> samplers;
  std::vector<TableRecord> tables;
};

/// Runs the benchmark program over `sample/` and reads what it measured. Throws InputError if it
/// cannot be started or fails, Interrupted if it was interrupted.
Throughput measure_throughput(const std::filesystem::path& program);

/// The rows named sample/<sampler>/<map>/<W>x<H>/random of such a file, medians over repetitions,
/// and those of the order `fused` that say what a texel's error is. Throws InputError naming the
/// file if it is not Google Benchmark's JSON, or has none of the first.
Throughput read_throughput(const std::filesystem::path& file);

/// How each sampler's time grows with S + T.
std::vector<GrowthFit> growth_of(std::span<const ThroughputRecord> records);

}  // namespace lightproof
