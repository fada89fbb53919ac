// write_sample_trend FILE: the page of a synthetic history, with everything that a page can hold.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "lightproof/core/atomic_file.h"
#include "lightproof/history/trend_page.h"
#include "synthetic_runs.h"

namespace lightproof::test {
namespace {

constexpr int kCommits = 30;

double level_of(int sampler, int commit) {
  if (sampler == 1 && commit >= 18) return 1.31;
  if (sampler == 2 && commit >= 8) return commit >= 20 ? 1.1 : 0.62;
  return 1.0;
}

std::vector<BenchmarkRun> synthetic_history() {
  constexpr const char* kSamplers[] = {"binary_search", "alias", "guide_table", "hierarchical",
                                       "</script><script>injected=1</script>"};
  const RandomStream stream("history/sample", 1);
  std::vector<BenchmarkRun> runs;
  for (int i = 0; i < 3 * kCommits; ++i) {
    const int commit = i / 3;
    std::vector<Measurement> measurements;
    for (int k = 0; k < 5; ++k) {
      const double z =
          normal_quantile(stream.point(static_cast<std::uint64_t>(5 * i + k)).s + 0x1p-54);
      const std::string name = fmt::format("sample/{}/sun-sky/2048x1024/random", kSamplers[k]);
      const double time = 20.0 * (k + 1) * level_of(k, commit) * std::exp(0.02 * z);
      measurements.push_back({name, Metric::nanoseconds, 0, time});
      measurements.push_back({fmt::format("count/{}/sun-sky/512x256", kSamplers[k]),
                              Metric::instructions, 0, 3e5 * (k == 1 && commit > 17 ? 1.25 : 1.0)});
    }
    runs.push_back(synthetic_run(fmt::format("{:08x}90abcdef", 0x1f3a7c * (commit + 3)),
                                 fmt::format("session {}", commit), 1000 * i, measurements));
  }
  // Too few commits for a change; a single one.
  runs.push_back(
      synthetic_run("c0ffee00", "last", 1000000, {{"new", Metric::nanoseconds, 0, 5.0}}));
  return runs;
}

}  // namespace
}  // namespace lightproof::test

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path file = argv[1];
  std::filesystem::create_directories(file.parent_path());
  lightproof::write_file(
      file,
      lightproof::trend_page(lightproof::trend_lines(lightproof::test::synthetic_history()), "0"));
  return 0;
}
