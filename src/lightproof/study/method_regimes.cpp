#include "lightproof/study/method_regimes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "lightproof/accuracy/measurement.h"
#include "lightproof/image/map_figures.h"
#include "lightproof/results/accuracy_reading.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr double kError = 0.05;
constexpr std::array kRoughnesses = {0.1, 0.2, 0.35, 0.5, 0.7, 1.0};
constexpr std::array kConcentrations = {0.3, 2.0, 8.0, 30.0, 120.0, 500.0, 2000.0};
constexpr Extent kMap = {256, 128};
constexpr AccuracyQuality kQuality = {"draft", 4096, 3, 24};
/// Towards it the visible half of a sphere is lit from the left above.
const Direction kTowardsLight = glm::normalize(Direction(-0.5, -0.6, 0.62));

/// Tables for every shading point take most of the time, and win nowhere.
bool is_charted(const EstimatorInfo& info) { return !info.tabulates_each_point; }

std::vector<MethodRegime> measure(std::uint64_t seed, const Progress& progress) {
  std::vector<AccuracyScene> scenes;
  for (const double roughness : kRoughnesses) {
    const std::string name = fmt::format("ggx:{}", roughness);
    scenes.push_back({&receiver_by_name("sphere"), {name, material_of(name)}});
  }
  std::vector<MethodRegime> regimes;
  for (std::size_t i = 0; i < kConcentrations.size(); ++i) {
    if (progress) {
      progress("regimes of methods",
               static_cast<double>(i) / static_cast<double>(kConcentrations.size()));
    }
    const EnvironmentMap map = one_light(kConcentrations[i], kMap);
    const double fraction = figures_of(map).effective_fraction;
    const auto charts =
        measure_accuracy(map, scenes, {.quality = kQuality, .seed = seed, .select = is_charted});
    for (std::size_t k = 0; k < scenes.size(); ++k) {
      regimes.push_back(regime_of(charts[k], kRoughnesses[k], fraction));
    }
  }
  return regimes;
}

}  // namespace

MethodRegime regime_of(const AccuracyChart& chart, double roughness, double effective_fraction) {
  MethodRegime regime{roughness, effective_fraction, {}, {}, 0.0, {}, 0.0};
  if (const auto fastest = fastest_to(chart, kError)) {
    regime.estimator = fastest->line->estimator;
    regime.family = fastest->line->family;
    regime.seconds = fastest->point.seconds;
  }
  AccuracyChart unbiased = chart;
  std::erase_if(unbiased.lines, [](const AccuracyLine& line) { return line.is_biased; });
  if (const auto fastest = fastest_to(unbiased, kError)) {
    regime.unbiased_estimator = fastest->line->estimator;
    regime.unbiased_seconds = fastest->point.seconds;
  }
  return regime;
}

EnvironmentMap one_light(double concentration, Extent extent) {
  EnvironmentMap map;
  map.name = fmt::format("light-{:g}", concentration);
  map.radiance = Grid<Rgb>(extent);
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const Direction at =
          direction_from_square({(x + 0.5) / extent.width, (y + 0.5) / extent.height});
      map.radiance(x, y) =
          Rgb(static_cast<float>(std::exp(concentration * (glm::dot(at, kTowardsLight) - 1.0))));
    }
  }
  return map;
}

MethodRegimes kept_method_regimes(std::uint64_t seed, const MeasurementCache& cache,
                                  const Progress& progress) {
  auto kept = MeasurementKeeper(cache).get<std::vector<MethodRegime>>(
      "method-regimes", fmt::format("{}", seed), [&] { return measure(seed, progress); });
  return {kError, std::move(kept.value), std::move(kept.origin)};
}

}  // namespace lightproof
