// Each task registers its benchmarks under task/method/map/resolution/order.
#pragma once

#include <benchmark/benchmark.h>

#include <span>
#include <string>

namespace lightproof::bench {

void register_sample_benchmarks();
void register_direction_benchmarks();
/// Registers the directions/ benchmarks of plug-ins, given by the paths of their shared libraries.
/// Throws InputError if one is no plug-in.
void register_plugin_benchmarks(std::span<const std::string> files);
void register_build_benchmarks();
void register_render_benchmarks();
void register_histogram_benchmarks();
void register_count_benchmarks();
void register_error_benchmarks();
void register_map_error_benchmarks();
void register_prediction_benchmarks();
void register_irradiance_benchmarks();
void register_prefilter_benchmarks();

/// Machine, compiler, flags and commit, beside what Google Benchmark says of itself.
void add_context();

/// Skips a benchmark whose sampler under test disagrees with the reference.
void disagree(benchmark::State& state, const std::string& why);

/// Whether anything that was to be timed disagreed with the reference.
bool any_disagreement();

}  // namespace lightproof::bench
