// How far precomputed maps are off: error/irradiance/<method>/<map>, error/specular/<method>/<map>,
// a chain of four levels, and error/brdf_map/<method>/<masking>.
//
// The counter error, relative and root mean square, of the BRDF map the largest absolute one,
// depends on nothing but the program: the history keeps it in place of the time.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "bench/level_error.h"
#include "bench/registration.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/prefilter/brdf_map.h"
#include "lightproof/prefilter/irradiance_map.h"
#include "lightproof/prefilter/riemann_irradiance.h"
#include "lightproof/prefilter/specular_chain.h"
#include "lightproof/prefilter/spherical_harmonics.h"
#include "reference/texel_integrals.h"

namespace lightproof::bench {
namespace {

constexpr Extent kExtent = {64, 32};
constexpr Extent kNormals = {32, 16};
constexpr int kLevels = 4;
constexpr const char* kMapName = "sun-sky";

const EnvironmentMap& map() {
  static const EnvironmentMap map = make_synthetic_map(kMapName, kExtent);
  return map;
}

double irradiance_error(const IrradianceMap& made) {
  return error_of(made, irradiance_map(map(), kNormals)).root_mean_square;
}

template <int kDegree>
double error_of_harmonics() {
  return irradiance_error(irradiance_map(irradiance_harmonics(project(map(), kDegree)), kNormals));
}

double error_of_riemann() {
  const NearestRadiance radiance(map());
  IrradianceMap made = dark_irradiance_map(kNormals);
  for (int y = 0; y < kNormals.height; ++y) {
    for (int x = 0; x < kNormals.width; ++x) {
      const Direction normal = normal_of_texel(kNormals, x, y);
      made.irradiance(x, y) =
          kPi * riemann_reflection(radiance, normal, {64, 16, RiemannNodes::midpoint}).rgb;
    }
  }
  return irradiance_error(made);
}

/// Over all levels but the mirror.
double chain_error(const PrefilterSettings& settings) {
  const SpecularChain chain =
      ggx_chain(map().radiance, kExtent, kLevels, GgxWeight::cosine, settings);
  const std::vector<double> roughness = level_roughness(kLevels);
  double sum = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const reference::Lobe lobe = reference::ggx_lobe(roughness[i] * roughness[i]);
    sum += relative_mean_square(chain[i],
                                reference::prefiltered(map().radiance, lobe, chain[i].extent()));
  }
  return std::sqrt(sum / (kLevels - 1));
}

/// The largest of either part.
double brdf_sum_error(Masking masking) {
  const Grid<ScaleBias> made = brdf_map(kNormals, masking, HammersleyRange::published(1024));
  const Grid<ScaleBias> exact = brdf_map(kNormals, masking);
  double largest = 0.0;
  for (std::size_t i = 0; i < made.values().size(); ++i) {
    const ScaleBias& a = made.values()[i];
    const ScaleBias& b = exact.values()[i];
    largest = std::max({largest, std::abs(a.scale - b.scale), std::abs(a.bias - b.bias)});
  }
  return largest;
}

void register_one(const std::string& name, const std::function<double()>& error) {
  benchmark::RegisterBenchmark(("error/" + name).c_str(),
                               [error](benchmark::State& state) {
                                 for (auto _ : state) state.counters["error"] = error();
                               })
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
}

void register_chain(const char* name, const PrefilterSettings& settings) {
  register_one(fmt::format("specular/{}/{}", name, kMapName),
               [settings] { return chain_error(settings); });
}

}  // namespace

void register_map_error_benchmarks() {
  register_one(fmt::format("irradiance/harmonics-2/{}", kMapName), error_of_harmonics<2>);
  register_one(fmt::format("irradiance/harmonics-16/{}", kMapName), error_of_harmonics<16>);
  register_one(fmt::format("irradiance/riemann-64x16/{}", kMapName), error_of_riemann);
  register_chain("half_vector_64", {PrefilterMethod::half_vector, 64});
  register_chain("lobe_64", {PrefilterMethod::lobe, 64});
  register_chain("filtered_16", {PrefilterMethod::filtered, 16});
  register_chain("spherical_harmonics_8", {PrefilterMethod::spherical_harmonics, 0, 8});
  register_chain("fast", {PrefilterMethod::fast});
  register_one("brdf_map/hammersley_1024/karis", [] { return brdf_sum_error(Masking::karis); });
  register_one("brdf_map/hammersley_1024/height-correlated",
               [] { return brdf_sum_error(Masking::height_correlated); });
}

}  // namespace lightproof::bench
