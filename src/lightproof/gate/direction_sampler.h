// Samplers of directions whose distribution has a formula: the hemisphere's warps, and materials
// seen from one side. In the gate they go through the same tests as samplers of maps.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "lightproof/gate/sampler_under_test.h"
#include "lightproof/gate/test_case.h"
#include "lightproof/materials/shading_point.h"
#include "reference/cosine_lobes.h"

namespace lightproof {

/// A direction and the density with which it was drawn.
struct DrawnDirection {
  Direction direction;
  PerSteradian pdf;
};

/// A sampler of directions, and the distribution that it claims to draw.
struct DirectionSampler {
  std::string name;
  std::string description;
  std::vector<reference::CosineLobe> distribution;  ///< what it claims to draw
  std::function<DrawnDirection(SquarePoint)> sample;
  std::function<PerSteradian(Direction)> pdf;
};

/// Every warp, and every material seen from the normal, at 45 and at 80 degrees: their names end in
/// the angle. The normal is +z.
std::vector<DirectionSampler> direction_samplers();

/// A sampler of directions as a source of samples over the square, which name cells of a grid. A
/// direction that is a pole is moved off it by less than any cell: there the square has no density.
BoundSampler bound_directions(const DirectionSampler& sampler, Extent cells);

/// The test cases of samplers of directions, one for each of them.
std::vector<TestCase> test_cases_of(std::span<const DirectionSampler> samplers);

/// The test cases of all samplers under test on all maps, then those of samplers of directions.
std::vector<TestCase> test_cases_of(std::span<const EnvironmentMap> maps,
                                    std::span<const SamplerUnderTest> samplers_under_test,
                                    std::span<const DirectionSampler> samplers);

}  // namespace lightproof
