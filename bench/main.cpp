#include <benchmark/benchmark.h>
#include <malloc.h>

#include <cstdio>
#include <exception>

#include "bench/registration.h"
#include "lightproof/core/failure.h"

namespace {

/// Tables get their memory from the system, as in a program that builds a table once. Left to
/// itself the heap keeps blocks of up to 32 MB as soon as one of that size has been freed, and what
/// ran before decides what a build takes (Vose's of 2048x1024 texels: 13 or 27 ms).
void keep_no_freed_memory() {
  constexpr int kFromTheSystem = 128 << 10;  // bytes: glibc's own threshold, but fixed
  mallopt(M_MMAP_THRESHOLD, kFromTheSystem);
}

}  // namespace

int main(int argc, char** argv) {
  keep_no_freed_memory();
  try {
    lightproof::bench::register_sample_benchmarks();
    lightproof::bench::register_direction_benchmarks();
    lightproof::bench::register_build_benchmarks();
    lightproof::bench::register_render_benchmarks();
    lightproof::bench::register_histogram_benchmarks();
    lightproof::bench::register_count_benchmarks();
    lightproof::bench::register_irradiance_benchmarks();
    lightproof::bench::register_prefilter_benchmarks();
    lightproof::bench::add_context();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    if (lightproof::bench::any_disagreement()) return 1;
  } catch (...) {
    const lightproof::Failure failure = lightproof::failure_of(std::current_exception());
    std::fprintf(stderr, "lightproof_bench: %s\n", failure.message.c_str());
    return failure.code;
  }
  return 0;
}
