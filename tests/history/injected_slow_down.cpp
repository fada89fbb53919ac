// A benchmark whose work can be made longer: injected_slow_down --work=110 does 10 % more than
// --work=100. What a performance gate must notice.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

/// A chain of multiplications, each of which waits for the one before: time and instructions are in
/// proportion to the number of steps, on any machine.
[[gnu::noinline]] std::uint64_t counted_kernel(std::uint64_t steps) {
  std::uint64_t x = steps;
  for (std::uint64_t i = 0; i < steps; ++i) {
    x = x * 6364136223846793005U + 1442695040888963407U;
    benchmark::DoNotOptimize(x);
  }
  return x;
}

void run(benchmark::State& state, std::uint64_t steps) {
  for (auto _ : state) benchmark::DoNotOptimize(counted_kernel(steps));
}

}  // namespace

int main(int argc, char** argv) {
  constexpr std::string_view kOption = "--work=";
  std::uint64_t percent = 100;
  if (argc > 1 && std::string_view(argv[1]).starts_with(kOption)) {
    percent = std::strtoull(argv[1] + kOption.size(), nullptr, 10);
    argv[1] = argv[0];
    --argc;
    ++argv;
  }
  const std::uint64_t steps = 100 * percent;
  benchmark::RegisterBenchmark("time/chain", run, steps);
  benchmark::RegisterBenchmark("count/chain", run, steps)->Iterations(1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
