// A benchmark program like lightproof_bench, whose only benchmark takes no time to speak of.
// A plug-in is timed as "mine", unless its file is called wrong.so.
#include <benchmark/benchmark.h>

#include <string_view>

namespace {

void sample(benchmark::State& state) {
  for (auto _ : state) benchmark::ClobberMemory();
  state.counters["ns_per_sample"] = 2.0;
  state.counters["table_bytes"] = 1024.0;
  state.counters["build_ms"] = 0.5;
}

void directions(benchmark::State& state) {
  for (auto _ : state) state.SetIterationTime(3e-9);
  state.counters["ns_per_sample"] = 3.0;
  state.counters["times_baseline"] = 5.0;
  state.counters["wall_per_cpu"] = 1.0;
}

void disagreeing(benchmark::State& state) { state.SkipWithError("the first sample is elsewhere"); }

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2 && std::string_view(argv[1]) == "--plugin") {
    const bool is_wrong = std::string_view(argv[2]) == "wrong.so";
    argv += 2;
    argc -= 2;
    benchmark::RegisterBenchmark("directions/mine/constant/2048x1024/C/batch",
                                 is_wrong ? disagreeing : directions)
        ->UseManualTime();
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RegisterBenchmark("sample/own/constant/256x128/random", sample);
  benchmark::RunSpecifiedBenchmarks();
}
