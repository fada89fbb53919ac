// Samplers of environment maps, before there is a map: one of the registry, a mutant, a third-party
// one.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "lightproof/gate/test_case.h"
#include "lightproof/image/map_store.h"
#include "lightproof/results/gate_result.h"
#include "lightproof/samplers/registry.h"

namespace lightproof {

/// A sampler of environment maps that the gate tests, before there is a map.
struct SamplerUnderTest {
  std::string name;
  TargetDensity target;  ///< what it claims to draw; on a map, on_map() of it
  bool known_defects = false;
  /// Whether it claims to return the texel of LinearScan for every point.
  bool inverts_shared_cdf = false;
  /// Builds the sampler of a map, which must outlive it. Throws InputError if the map is black.
  std::function<BoundSampler(const EnvironmentMap&)> bind;
  double resolution = 0x1p-24;  ///< SamplerInstance::resolution
  bool inverts_rows = false;    ///< SamplerInstance::inverts_rows
  /// The rounding of its probabilities on a map of this size; null: it claims the declared density
  /// exactly.
  MassRounding (*rounding)(Extent map) = nullptr;
  /// Empty if it can be told from a correct sampler on maps of this mapping; else why not. Null: it
  /// always can.
  std::function<std::string_view(const Mapping&)> why_meaningless = {};
};

/// Empty if a sampler is tested on maps of this mapping; else why not: its density cannot be
/// declared there, or it has no meaning.
std::string_view why_left_out(const SamplerUnderTest& under_test, const Mapping& mapping);
inline std::string_view why_left_out(const SamplerUnderTest& under_test,
                                     const EnvironmentMap& map) {
  return why_left_out(under_test, map.mapping);
}

/// The samplers under test that are left out on some of these maps.
std::vector<LeftOut> left_out_on(std::span<const MapSource> maps,
                                 std::span<const SamplerUnderTest> samplers_under_test);
std::vector<LeftOut> left_out_on(std::span<const EnvironmentMap> maps,
                                 std::span<const SamplerUnderTest> samplers_under_test);

/// A sampler of the registry as one under test, under one density.
SamplerUnderTest sampler_under_test(const SamplerInfo& sampler, DensitySpace density_space);

/// Every sampler of the registry under all densities.
std::vector<SamplerUnderTest> all_samplers_under_test();

/// The test cases of every sampler under test on every map that it is not left out on, one for each
/// map and target density. A map is loaded when one of them asks for it, and lasts as long as the
/// exact side: whoever binds a sampler holds that.
std::vector<TestCase> test_cases_of(std::span<const MapSource> maps,
                                    std::span<const SamplerUnderTest> samplers_under_test);
/// The test cases of maps that are in memory, and which must outlive them.
std::vector<TestCase> test_cases_of(std::span<const EnvironmentMap> maps,
                                    std::span<const SamplerUnderTest> samplers_under_test);

}  // namespace lightproof
