#include "lightproof/gate/sampler_under_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "lightproof/core/out_of_memory.h"
#include "lightproof/gate/alternative_distribution.h"
#include "reference/texel_masses.h"

namespace lightproof {
namespace {

/// Does the work, with lack of memory laid to this part of a gate over the map.
template <class Work>
auto on(const EnvironmentMap& map, std::string_view part, const Work& work) {
  const auto purpose = [&] {
    return fmt::format("{} {} ({}x{})", part, map.name, map.radiance.extent().width,
                       map.radiance.extent().height);
  };
  return with_memory_for(purpose, work);
}

std::vector<Alternative> alternatives_on(const EnvironmentMap& map, TargetDensity target) {
  const auto declared = std::make_shared<const Grid<double>>(reference::texel_masses(map, target));
  std::vector<Alternative> alternatives;
  for (const AlternativeDistribution& distribution : alternative_distributions()) {
    if (distribution.is_example) continue;
    if (!why_meaningless(distribution.need, map.mapping).empty()) continue;
    alternatives.push_back({distribution.name, distribution.diagnosis_on(map.mapping),
                            [declared, &map, target, masses = distribution.masses] {
                              return masses({declared.get(), &map, target});
                            }});
  }
  return alternatives;
}

SamplerInstance instance_of(const SamplerUnderTest& under_test, const EnvironmentMap& map) {
  return {.name = under_test.name,
          .known_defects = under_test.known_defects,
          .bind = [bind = under_test.bind, name = under_test.name,
                   &map] { return on(map, name + " on", [&] { return bind(map); }); },
          .resolution = under_test.resolution,
          .rounding = under_test.rounding != nullptr ? under_test.rounding(map.radiance.extent())
                                                     : MassRounding{},
          .inverts_rows = under_test.inverts_rows,
          .claims_reference_texels = under_test.inverts_shared_cdf};
}

std::function<BoundSampler()> linear_scan_of(const EnvironmentMap& map, TargetDensity target) {
  return [&map, target] {
    return on(map, "linear_scan on", [&] { return bound(LinearScan(map, target)); });
  };
}

/// The target densities of the samplers under test on a map, each once.
std::vector<TargetDensity> targets_of(std::span<const SamplerUnderTest> samplers_under_test,
                                      const EnvironmentMap& map) {
  std::vector<TargetDensity> targets;
  for (const SamplerUnderTest& under_test : samplers_under_test) {
    if (!why_left_out(under_test, map).empty()) continue;
    const TargetDensity target = on_map(under_test.target, map);
    if (std::find(targets.begin(), targets.end(), target) == targets.end()) {
      targets.push_back(target);
    }
  }
  return targets;
}

/// What all samplers under test of one target density on a map are held against.
TestCase test_case_of(const EnvironmentMap& map, TargetDensity target) {
  return {map.name,
          std::string(to_string(target.density_space)),
          map.source,
          [&map, target] {
            return on(map, "the exact distribution of", [&] {
              return std::make_shared<const Expectation>(expectation_of(map, target));
            });
          },
          [&map, target] {
            return on(map, "the alternative distributions of",
                      [&] { return alternatives_on(map, target); });
          },
          {}};
}

}  // namespace

SamplerUnderTest sampler_under_test(const SamplerInfo& sampler, DensitySpace density_space) {
  return {std::string(sampler.name),
          sampler.target(density_space),
          sampler.known_defects,
          sampler.inverts_shared_cdf,
          [make = sampler.make, density_space](const EnvironmentMap& map) {
            return std::visit([](auto made) { return bound(std::move(made)); },
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

std::string_view why_left_out(const SamplerUnderTest& under_test, const EnvironmentMap& map) {
  const std::string_view reason = why_not_declared(under_test.target, map.mapping);
  if (!reason.empty() || !under_test.why_meaningless) return reason;
  return under_test.why_meaningless(map.mapping);
}

std::vector<LeftOut> left_out_on(std::span<const EnvironmentMap> maps,
                                 std::span<const SamplerUnderTest> samplers_under_test) {
  std::vector<LeftOut> left_out;
  for (const EnvironmentMap& map : maps) {
    for (const SamplerUnderTest& under_test : samplers_under_test) {
      const std::string_view reason = why_left_out(under_test, map);
      if (reason.empty()) continue;
      left_out.push_back({under_test.name, std::string(to_string(under_test.target.density_space)),
                          map.name, std::string(reason)});
    }
  }
  return left_out;
}

std::vector<TestCase> test_cases_of(std::span<const EnvironmentMap> maps,
                                    std::span<const SamplerUnderTest> samplers_under_test) {
  std::vector<TestCase> test_cases;
  for (const EnvironmentMap& map : maps) {
    for (const TargetDensity target : targets_of(samplers_under_test, map)) {
      TestCase test_case = test_case_of(map, target);
      for (const SamplerUnderTest& under_test : samplers_under_test) {
        if (!(on_map(under_test.target, map) == target)) continue;
        if (!why_left_out(under_test, map).empty()) continue;
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
