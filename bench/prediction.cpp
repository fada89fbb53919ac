// What a recommendation takes that is not measured on the map:
// recommend/<map>/<resolution>/<material> for its prediction, and
// recommend/one_pass/<map>/<resolution> for one pass over the same texels.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <map>
#include <string>

#include "bench/maps.h"
#include "bench/registration.h"
#include "lightproof/accuracy/method_costs.h"
#include "lightproof/recommend/recommend.h"
#include "lightproof/render/receiver.h"

namespace lightproof::bench {
namespace {

constexpr const char* kMaterials[] = {"lambert", "phong:50", "ggx:0.3"};
constexpr const char* kReceiver = "sphere";

/// Measured once a program: they are kept for the machine, not made anew for each map.
const MethodCosts& costs_of(const std::string& material) {
  static std::map<std::string, MethodCosts> costs;
  const auto found = costs.find(material);
  if (found != costs.end()) return found->second;
  return costs[material] = measure_method_costs(material_of(material), receiver_by_name(kReceiver));
}

void predict(benchmark::State& state, const EnvironmentMap& map, const std::string& material) {
  RecommendOptions options{&receiver_by_name(kReceiver), {material, material_of(material)}, {}};
  options.verify = false;
  const MethodCosts& costs = costs_of(material);
  for (auto _ : state) benchmark::DoNotOptimize(recommend(map, options, costs));
}

void pass_over(benchmark::State& state, const EnvironmentMap& map) {
  for (auto _ : state) benchmark::DoNotOptimize(luminance_of(map));
}

}  // namespace

void register_prediction_benchmarks() {
  for (const Extent extent : {Extent{1024, 512}, Extent{2048, 1024}}) {
    const std::string name = fmt::format("{}/{}x{}", kMap, extent.width, extent.height);
    benchmark::RegisterBenchmark(
        ("recommend/one_pass/" + name).c_str(),
        [extent](benchmark::State& state) { pass_over(state, map_of(extent)); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
    for (const std::string material : kMaterials) {
      benchmark::RegisterBenchmark(
          fmt::format("recommend/{}/{}", name, material).c_str(),
          [=](benchmark::State& state) { predict(state, map_of(extent), material); })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    }
  }
}

}  // namespace lightproof::bench
