#include "lightproof/study/study.h"

#include <fmt/format.h>

#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "lightproof/accuracy/method_costs.h"
#include "lightproof/core/error.h"
#include "lightproof/core/machine.h"
#include "lightproof/core/random.h"
#include "lightproof/gate/direction_sampler.h"
#include "lightproof/image/lat_long_texels.h"
#include "lightproof/image/map_figures.h"
#include "lightproof/recommend/recommend.h"
#include "lightproof/samplers/binary_search.h"
#include "lightproof/study/growth.h"
#include "lightproof/study/kept_directions.h"
#include "lightproof/study/split_sum.h"
#include "lightproof/study/warp_grids.h"

namespace lightproof {
namespace {

constexpr std::uint64_t kDrawnPoints = 400;

}  // namespace

namespace {

/// The record of a map, but for the map.
MapRecord describe_without_map(const EnvironmentMap& own, std::uint64_t seed) {
  MapRecord record;
  record.own_mapping = own.mapping;
  record.own_texels = own.radiance.extent();
  std::optional<EnvironmentMap> resampled;
  if (!is_plain(own.mapping)) resampled = resampled_to_lat_long(own);
  const EnvironmentMap& map = resampled ? *resampled : own;
  record.source = map.name;
  const MapFigures figures = figures_of(map);
  record.mean_luminance = figures.mean_luminance;
  record.peak_ratio = figures.peak_luminance / figures.mean_luminance;
  record.effective_fraction = figures.effective_fraction;
  const BinarySearch sampler(map, on_map({DensitySpace::solid_angle}, map));
  const RandomStream stream("drawn/" + map.name, seed);
  for (std::uint64_t i = 0; i < kDrawnPoints; ++i) {
    record.drawn.push_back(sampler.sample(stream.point(i)).at);
  }
  return record;
}

}  // namespace

MapRecord describe_map(EnvironmentMap own, std::uint64_t seed) {
  MapRecord record = describe_without_map(own, seed);
  record.map = resampled_to_lat_long(std::move(own));
  return record;
}

void recommend_methods(const EnvironmentMap& map, const StudyOptions& options,
                       const Progress& progress, StudyResult& result) {
  for (const AccuracyScene& scene : options.accuracy_scenes) {
    const MethodCosts costs =
        kept_method_costs(scene.material.material, *scene.receiver, options.cache, progress).value;
    const RecommendOptions asked = {scene.receiver,
                                    scene.material,
                                    {.error = *options.recommended_error},
                                    true,
                                    options.accuracy.seed};
    try {
      result.recommendations.push_back(recommend(map, asked, costs, progress));
    } catch (const NoMethodReaches& none) {
      result.refused_recommendations.push_back(none.refused());
    }
  }
}

namespace {

/// What is recommended on a map, and where nothing is.
struct RecommendedOnMap {
  std::vector<Recommendation> recommended;
  std::vector<RefusedRecommendation> refused;

  static auto fields(auto& all) { return std::tie(all.recommended, all.refused); }
};

template <class Value>
void append(std::vector<Value>& values, std::vector<Value> more) {
  std::move(more.begin(), more.end(), std::back_inserter(values));
}

void study_accuracy(std::span<const EnvironmentMap> maps, const StudyOptions& options,
                    const Progress& progress, const UnfinishedWork& unfinished,
                    StudyResult& result) {
  if (options.accuracy_scenes.empty()) return;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const auto part = [&](double from, double to) {
      const auto count = static_cast<double>(maps.size());
      const auto first = static_cast<double>(i);
      return part_of(progress, (first + from) / count, (first + to) / count);
    };
    append(result.accuracy, unfinished.stage<std::vector<AccuracyChart>>(
                                "accuracy/" + maps[i].name, [&](const Communicator& communicator) {
                                  return measure_accuracy(maps[i], options.accuracy_scenes,
                                                          options.accuracy, part(0.0, 0.7),
                                                          communicator);
                                }));
    if (!options.recommended_error) continue;
    auto on_map = unfinished.stage<RecommendedOnMap>(
        "recommendations/" + maps[i].name, [&](const Communicator& /*communicator*/) {
          StudyResult of_map;
          recommend_methods(maps[i], options, part(0.7, 1.0), of_map);
          return RecommendedOnMap{std::move(of_map.recommendations),
                                  std::move(of_map.refused_recommendations)};
        });
    append(result.recommendations, std::move(on_map.recommended));
    append(result.refused_recommendations, std::move(on_map.refused));
  }
}

std::vector<RenderRecord> study_pictures(std::span<const EnvironmentMap> maps,
                                         const StudyOptions& options, const Progress& progress,
                                         const UnfinishedWork& unfinished) {
  std::vector<RenderRecord> records;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const auto count = static_cast<double>(maps.size());
    const auto first = static_cast<double>(i);
    append(records, unfinished.stage<std::vector<RenderRecord>>(
                        "renders/" + maps[i].name, [&](const Communicator& /*communicator*/) {
                          return study_renders(
                              maps.subspan(i, 1), options.renders,
                              part_of(progress, first / count, (first + 1.0) / count));
                        }));
  }
  return records;
}

}  // namespace

void set_throughput(StudyResult& study, Throughput measured) {
  study.throughput = std::move(measured.samplers);
  study.tables = std::move(measured.tables);
  study.directions = std::move(measured.directions);
  study.caches = measured.caches;
  study.throughput_origin = std::move(measured.origin);
  study.growth = growth_of(study.throughput, study.caches);
}

StudyResult run_study(std::vector<EnvironmentMap> maps, const StudyOptions& options,
                      const Progress& progress, const UnfinishedWork& unfinished) {
  StudyResult result;
  result.version = LIGHTPROOF_VERSION;
  result.machine = machine_name();
  result.seed = options.gate.seed;
  // Speed first, while nothing else has warmed or filled the machine.
  // Shares of the time that each part takes on eight maps.
  const double gate_start = options.throughput ? 0.1 : 0.0;
  if (options.throughput) {
    if (progress) progress("throughput", 0.0);
    set_throughput(result,
                   unfinished.stage<Throughput>("throughput", [&](const Communicator& /*alone*/) {
                     return measure_throughput(*options.throughput);
                   }));
  }
  for (const EnvironmentMap& map : maps) {
    result.maps.push_back(describe_without_map(map, options.gate.seed));
  }
  const auto directions = unfinished.stage<KeptMeasurement<ScreenedRuns>>(
      "directions", [&](const Communicator& communicator) {
        return kept_directions(options.gate, options.cache, part_of(progress, gate_start, 0.2),
                               communicator);
      });
  result.directions_origin = directions.origin;
  result.gate = unfinished.stage<GateResult>("gate", [&](const Communicator& communicator) {
    return run_gate(test_cases_of(maps, options.samplers, direction_samplers()), options.gate,
                    part_of(progress, 0.2, 0.5), communicator, directions.value);
  });
  result.gate.left_out = left_out_on(maps, options.samplers);
  for (EnvironmentMap& map : maps) map = resampled_to_lat_long(std::move(map));
  result.convergence = unfinished.stage<std::vector<ConvergenceRecord>>(
      "convergence", [&](const Communicator& communicator) {
        return study_convergence(maps, options.convergence, part_of(progress, 0.5, 0.75),
                                 communicator);
      });
  study_accuracy(maps, options, part_of(progress, 0.75, 0.93), unfinished, result);
  result.warps = study_warp_grids(maps);
  result.renders = study_pictures(maps, options, part_of(progress, 0.93, 0.98), unfinished);
  result.split_sum = unfinished.stage<std::vector<SplitSumRecord>>(
      "split-sum", [&](const Communicator& communicator) {
        return study_split_sum(maps, {}, part_of(progress, 0.98, 1.0), communicator);
      });
  // Last, so that there is one copy of each.
  for (std::size_t i = 0; i < maps.size(); ++i) result.maps[i].map = std::move(maps[i]);
  return result;
}

}  // namespace lightproof
