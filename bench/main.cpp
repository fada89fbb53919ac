#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/registration.h"
#include "bench/reporter.h"
#include "lightproof/core/failure.h"
#include "lightproof/core/heap.h"
#include "lightproof/core/spawn.h"

namespace {

/// Takes `--plugin FILE` and `--plugin=FILE`, of which Google Benchmark knows nothing, out of the
/// arguments, and returns the files.
std::vector<std::string> take_plugins(int& count, char** arguments) {
  constexpr std::string_view kOption = "--plugin";
  std::vector<std::string> files;
  int kept = 1;
  for (int i = 1; i < count; ++i) {
    const std::string_view word = arguments[i];
    if (word == kOption && i + 1 < count) {
      files.emplace_back(arguments[++i]);
    } else if (word.starts_with("--plugin=")) {
      files.emplace_back(word.substr(kOption.size() + 1));
    } else {
      arguments[kept++] = arguments[i];
    }
  }
  count = kept;
  arguments[count] = nullptr;
  return files;
}

/// Google Benchmark takes a reporter for a file only where the command line names one.
bool writes_file(std::span<char*> arguments) {
  return std::ranges::any_of(arguments, [](std::string_view argument) {
    return argument.starts_with("--benchmark_out=");
  });
}

}  // namespace

int main(int argc, char** argv) {
  // Tables get their memory from the system, as in a program that builds a table once: Vose's of
  // 2048x1024 texels else takes 13 or 27 ms.
  lightproof::keep_no_freed_memory();
  lightproof::end_with_parent();
  try {
    lightproof::bench::register_sample_benchmarks();
    lightproof::bench::register_direction_benchmarks();
    lightproof::bench::register_plugin_benchmarks(take_plugins(argc, argv));
    lightproof::bench::register_build_benchmarks();
    lightproof::bench::register_render_benchmarks();
    lightproof::bench::register_histogram_benchmarks();
    lightproof::bench::register_count_benchmarks();
    lightproof::bench::register_error_benchmarks();
    lightproof::bench::register_map_error_benchmarks();
    lightproof::bench::register_prediction_benchmarks();
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
