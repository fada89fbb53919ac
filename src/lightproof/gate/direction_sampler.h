// Samplers of directions whose distribution has a formula: the hemisphere's warps, and materials
// seen from one side. In the gate they go through the same tests as samplers of maps.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/gate/direction_distribution.h"
#include "lightproof/gate/sampler_under_test.h"
#include "lightproof/gate/test_case.h"
#include "lightproof/materials/material.h"

namespace lightproof {

/// A sampler of directions, and the distribution that it claims to draw.
struct DirectionSamplerInfo {
  std::string name;
  std::string description;
  DirectionDistribution distribution;  ///< what it claims to draw
  std::function<DrawnDirection(SquarePoint)> sample;
  std::function<PerSteradian(Direction)> pdf;
};

/// The warps of the hemisphere, around +z and around an oblique normal.
std::vector<DirectionSamplerInfo> warp_samplers();

/// A way to draw microfacets, at any roughness in (0, 1].
struct MicrofacetInfo {
  std::string_view name;
  std::string_view description;
  Material (*of_roughness)(double roughness);
};

/// Every way to draw microfacets.
std::span<const MicrofacetInfo> microfacets();

/// Every warp, around +z and around an oblique normal, and every kind of material seen from the
/// normal, at 45, at 80 and at 89.9 degrees: their names end in the angle. Each way to draw
/// microfacets is seen from every angle, at one of the roughnesses of all_direction_samplers().
std::vector<DirectionSamplerInfo> direction_samplers();

/// All direction samplers: direction_samplers(), and each way to draw microfacets at every
/// roughness and every angle.
std::vector<DirectionSamplerInfo> all_direction_samplers();

/// A sampler of directions as a source of samples over the square, which name cells of its
/// distribution.
BoundSampler bound_directions(const DirectionSamplerInfo& sampler);

/// The test cases of samplers of directions, one for each of them.
std::vector<TestCase> test_cases_of(std::span<const DirectionSamplerInfo> samplers);

/// The test cases of all samplers under test on all maps, then those of samplers of directions.
std::vector<TestCase> test_cases_of(std::span<const MapSource> maps,
                                    std::span<const SamplerUnderTest> samplers_under_test,
                                    std::span<const DirectionSamplerInfo> samplers);
std::vector<TestCase> test_cases_of(std::span<const EnvironmentMap> maps,
                                    std::span<const SamplerUnderTest> samplers_under_test,
                                    std::span<const DirectionSamplerInfo> samplers);

}  // namespace lightproof
