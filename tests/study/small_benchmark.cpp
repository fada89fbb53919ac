// A benchmark program like lightproof_bench, whose only benchmark takes no time to speak of.
#include <benchmark/benchmark.h>

namespace {

void sample(benchmark::State& state) {
  for (auto _ : state) benchmark::ClobberMemory();
  state.counters["ns_per_sample"] = 2.0;
  state.counters["table_bytes"] = 1024.0;
  state.counters["build_ms"] = 0.5;
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  benchmark::RegisterBenchmark("sample/own/constant/256x128/random", sample);
  benchmark::RunSpecifiedBenchmarks();
}
