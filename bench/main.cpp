#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <span>
#include <string_view>

#include "bench/registration.h"
#include "bench/reporter.h"
#include "lightproof/core/failure.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

/// Tables get their memory from the system, as in a program that builds a table once. Left to
/// itself the heap keeps blocks of up to 32 MB as soon as one of that size has been freed, and what
/// ran before decides what a build takes (Vose's of 2048x1024 texels: 13 or 27 ms).
void keep_no_freed_memory() {
#ifdef __GLIBC__
  constexpr int kFromTheSystem = 128 << 10;  // bytes: glibc's own threshold, but fixed
  mallopt(M_MMAP_THRESHOLD, kFromTheSystem);
#endif
}

/// Google Benchmark takes a reporter for a file only where the command line names one.
bool writes_file(std::span<char*> arguments) {
  return std::ranges::any_of(arguments, [](std::string_view argument) {
    return argument.starts_with("--benchmark_out=");
  });
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
    lightproof::bench::register_error_benchmarks();
    lightproof::bench::register_map_error_benchmarks();
    lightproof::bench::register_irradiance_benchmarks();
    lightproof::bench::register_prefilter_benchmarks();
    lightproof::bench::add_context();
    const bool has_file = writes_file(std::span(argv, static_cast<std::size_t>(argc)));
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    const auto display = lightproof::bench::display_reporter();
    const auto file = has_file ? lightproof::bench::file_reporter() : nullptr;
    benchmark::RunSpecifiedBenchmarks(display.get(), file.get());
    benchmark::Shutdown();
    if (lightproof::bench::any_disagreement()) return 1;
  } catch (...) {
    const lightproof::Failure failure = lightproof::failure_of(std::current_exception());
    std::fprintf(stderr, "lightproof_bench: %s\n", failure.message.c_str());
    return failure.code;
  }
  return 0;
}
