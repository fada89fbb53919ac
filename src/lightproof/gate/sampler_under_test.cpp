#include "lightproof/gate/sampler_under_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "lightproof/core/out_of_memory.h"
#include "lightproof/gate/alternative_distribution.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

/// Does the work with the map, with lack of memory laid to this part of a gate over it.
template <class Work>
auto on(const MapSource& source, std::string_view part, const Work& work) {
  const auto purpose = [&] {
    return fmt::format("{} {} ({}x{})", part, source.name, source.extent.width,
                       source.extent.height);
  };
  return with_memory_for(purpose, [&] { return work(source.load()); });
}

std::vector<Alternative> alternatives_on(const std::shared_ptr<const EnvironmentMap>& map,
                                         TargetDensity target) {
  const auto declared = std::make_shared<const Grid<double>>(reference::texel_masses(*map, target));
  std::vector<Alternative> alternatives;
  for (const AlternativeDistribution& distribution : alternative_distributions()) {
    if (distribution.is_example) continue;
    if (!why_meaningless(distribution.need, map->mapping).empty()) continue;
    alternatives.push_back({distribution.name, distribution.diagnosis_on(map->mapping),
                            [declared, map, target, masses = distribution.masses] {
                              return masses({declared.get(), map.get(), target});
                            }});
  }
  return alternatives;
}

SamplerInstance instance_of(const SamplerUnderTest& under_test, const MapSource& source) {
  return {.name = under_test.name,
          .known_defects = under_test.known_defects,
          .bind =
              [bind = under_test.bind, name = under_test.name, source] {
                return on(source, name + " on", [&](const auto& map) { return bind(*map); });
              },
          .resolution = under_test.resolution,
          .rounding =
              under_test.rounding != nullptr ? under_test.rounding(source.extent) : MassRounding{},
          .inverts_rows = under_test.inverts_rows,
          .claims_reference_texels = under_test.inverts_shared_cdf};
}

std::function<BoundSampler()> linear_scan_of(const MapSource& source, TargetDensity target) {
  return [source, target] {
    return on(source, "linear_scan on",
              [&](const auto& map) { return bound(LinearScan(*map, target)); });
  };
}

/// The target densities of the samplers under test on a map, each once.
std::vector<TargetDensity> targets_of(std::span<const SamplerUnderTest> samplers_under_test,
                                      const MapSource& map) {
  std::vector<TargetDensity> targets;
  for (const SamplerUnderTest& under_test : samplers_under_test) {
    if (!why_left_out(under_test, map.mapping).empty()) continue;
    const TargetDensity target = on_map(under_test.target, map.weights);
    if (std::find(targets.begin(), targets.end(), target) == targets.end()) {
      targets.push_back(target);
    }
  }
  return targets;
}

/// What all samplers under test of one target density on a map are held against.
TestCase test_case_of(const MapSource& source, TargetDensity target) {
  return {source.name,
          std::string(to_string(target.density_space)),
          source.source,
          [source, target] {
            return on(source, "the exact distribution of",
                      [&](const auto& map) { return shared_expectation_of(map, target); });
          },
          [source, target] {
            return on(source, "the alternative distributions of",
                      [&](const auto& map) { return alternatives_on(map, target); });
          },
          {},
          {},
          source.extent.count()};
}

/// A sampler as a source of the many samples of a run.
template <EnvSampler Sampler>
BoundSampler bound_for_run(Sampler sampler) {
  return bound(std::move(sampler));
}
BoundSampler bound_for_run(LinearScanPublished scan) { return bound(CachedScan(std::move(scan))); }

}  // namespace

SamplerUnderTest sampler_under_test(const SamplerInfo& sampler, DensitySpace density_space) {
  return {std::string(sampler.name),
          sampler.target(density_space),
          sampler.known_defects,
          sampler.inverts_shared_cdf,
          [make = sampler.make, density_space](const EnvironmentMap& map) {
            return std::visit([](auto made) { return bound_for_run(std::move(made)); },
                              make(map, density_space));
          },
          sampler.resolution,
          sampler.inverts_rows,
          sampler.rounding};
}

std::vector<SamplerUnderTest> all_samplers_under_test() {
  std::vector<SamplerUnderTest> samplers_under_test;
  for (const SamplerInfo& sampler : samplers()) {
    for (const DensityInfo& density : kDensities) {
      samplers_under_test.push_back(sampler_under_test(sampler, density.density_space));
    }
  }
  return samplers_under_test;
}

std::string_view why_left_out(const SamplerUnderTest& under_test, const Mapping& mapping) {
  const std::string_view reason = why_not_declared(under_test.target, mapping);
  if (!reason.empty() || !under_test.why_meaningless) return reason;
  return under_test.why_meaningless(mapping);
}

std::vector<LeftOut> left_out_on(std::span<const EnvironmentMap> maps,
                                 std::span<const SamplerUnderTest> samplers_under_test) {
  return left_out_on(sources_of(maps), samplers_under_test);
}

std::vector<LeftOut> left_out_on(std::span<const MapSource> maps,
                                 std::span<const SamplerUnderTest> samplers_under_test) {
  std::vector<LeftOut> left_out;
  for (const MapSource& map : maps) {
    for (const SamplerUnderTest& under_test : samplers_under_test) {
      const std::string_view reason = why_left_out(under_test, map.mapping);
      if (reason.empty()) continue;
      left_out.push_back({under_test.name, std::string(to_string(under_test.target.density_space)),
                          map.name, std::string(reason)});
    }
  }
  return left_out;
}

std::vector<TestCase> test_cases_of(std::span<const EnvironmentMap> maps,
                                    std::span<const SamplerUnderTest> samplers_under_test) {
  return test_cases_of(sources_of(maps), samplers_under_test);
}

std::vector<TestCase> test_cases_of(std::span<const MapSource> maps,
                                    std::span<const SamplerUnderTest> samplers_under_test) {
  std::vector<TestCase> test_cases;
  for (const MapSource& map : maps) {
    for (const TargetDensity target : targets_of(samplers_under_test, map)) {
      TestCase test_case = test_case_of(map, target);
      for (const SamplerUnderTest& under_test : samplers_under_test) {
        if (!(on_map(under_test.target, map.weights) == target)) continue;
        if (!why_left_out(under_test, map.mapping).empty()) continue;
        test_case.instances.push_back(instance_of(under_test, map));
        if (under_test.inverts_shared_cdf)
          test_case.reference_implementation = linear_scan_of(map, target);
      }
      test_cases.push_back(std::move(test_case));
    }
  }
  return test_cases;
}

}  // namespace lightproof
