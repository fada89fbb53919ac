#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>

#include "bench/registration.h"

int main(int argc, char** argv) {
  try {
    lightproof::bench::register_sample_benchmarks();
    lightproof::bench::register_build_benchmarks();
    lightproof::bench::register_render_benchmarks();
    lightproof::bench::register_histogram_benchmarks();
    lightproof::bench::register_count_benchmarks();
    lightproof::bench::add_context();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    if (lightproof::bench::any_disagreement()) return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lightproof_bench: %s\n", error.what());
    return 2;
  }
  return 0;
}
