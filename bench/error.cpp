// How far estimators are off: error/<estimator>/<map>/<material>, 64 samples of all points of a
// sphere, or as few as draw 64 directions.
//
// The counter error, root mean square over the mean, depends on the seed alone: the history keeps
// it in place of the time, and any growth beyond rounding is a regression.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/registration.h"
#include "lightproof/accuracy/measurement.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/image/synthetic.h"

namespace lightproof::bench {
namespace {

constexpr Extent kMap = {256, 128};
constexpr const char* kMapName = "sun-sky";
constexpr std::uint64_t kDirections = 64;
constexpr AccuracyQuality kQuality = {"", kDirections, 4, kReceiverPoints};

/// The map and a sphere of a material under it, whose exact light is computed once.
const LitReceiver& lit_sphere(const std::string& material) {
  static const EnvironmentMap map = make_synthetic_map(kMapName, kMap);
  static std::map<std::string, std::unique_ptr<LitReceiver>> all;
  std::unique_ptr<LitReceiver>& lit = all[material];
  if (!lit) {
    lit = std::make_unique<LitReceiver>(
        map, receiver_by_name("sphere"), NamedMaterial{material, material_of(material)},
        kReceiverPoints, [](const EstimatorInfo&) { return false; });
  }
  return *lit;
}

double error_of(const EstimatorInfo& info, const std::string& material) {
  const std::uint64_t samples =
      info.ignores_budget ? 1 : std::max<std::uint64_t>(1, kDirections / info.candidates);
  const AccuracyOptions options = {
      .quality = kQuality,
      .select = [&](const EstimatorInfo& row) { return row.name == info.name; },
      .samples = [&](const EstimatorInfo&) { return std::vector{samples}; }};
  return measure_accuracy(lit_sphere(material), options).lines.front().points.front().rmse;
}

void run(benchmark::State& state, const EstimatorInfo& info, const std::string& material) {
  for (auto _ : state) state.counters["error"] = error_of(info, material);
}

}  // namespace

void register_error_benchmarks() {
  for (const EstimatorInfo& info : estimators()) {
    for (const char* material : {"lambert", "phong:50", "ggx:0.3"}) {
      if (!info.serves(material_of(material))) continue;
      const std::string name = fmt::format("error/{}/{}/{}", info.name, kMapName, material);
      benchmark::RegisterBenchmark(
          name.c_str(), [&info, material](benchmark::State& state) { run(state, info, material); })
          ->Iterations(1)
          ->Unit(benchmark::kMillisecond);
    }
  }
}

}  // namespace lightproof::bench
