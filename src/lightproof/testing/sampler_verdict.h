// The gate's verdict on a sampler of your own, for your own tests.
//
//   #include "lightproof/testing/sampler_verdict.h"
//   const lightproof::SamplerVerdict verdict = lightproof::judge_sampler<MySampler>("mine");
//   REQUIRE(verdict.is_accepted);  // verdict.text says why not, and what it looks like
//
// MySampler is made of a lightproof::EnvironmentMap, and draws directions or points of the map's
// square. gtest.h makes a GoogleTest of it in one line.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lightproof/gate/bound_sampler.h"
#include "lightproof/gate/sampler_under_test.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/image/target_density.h"
#include "lightproof/results/gate_result.h"
#include "lightproof/results/outcome.h"
#include "lightproof/warp/mapping.h"

namespace lightproof {

/// A sampler that draws directions, as an environment light does: sample(u) has the members
/// `direction`, a unit vector with z up, and `pdf`, per steradian; pdf(direction) is the density of
/// any direction. Both numbers of u lie in [0, 1).
template <class T>
concept DirectionSampler = requires(const T sampler, SquarePoint u, Direction direction) {
  { sampler.sample(u).direction } -> std::convertible_to<Direction>;
  { sampler.sample(u).pdf } -> std::convertible_to<PerSteradian>;
  { sampler.pdf(direction) } -> std::convertible_to<PerSteradian>;
};

/// A sampler that draws points of the map's square, with a density per unit square: like
/// EnvSampler, without the table's size.
template <class T>
concept SquareSampler = requires(const T sampler, SquarePoint u) {
  { sampler.sample(u) } -> std::convertible_to<TexelSample>;
  { sampler.pdf(u) } -> std::convertible_to<PerSquare>;
};

/// A sampler that judge_sampler() takes.
template <class T>
concept TestableSampler = std::constructible_from<T, const EnvironmentMap&> &&
    (DirectionSampler<T> || SquareSampler<T>);

/// How a sampler is tested.
struct SamplerTestOptions {
  /// What it claims to draw: by default what pbrt, Mitsuba and Cycles do, texels in proportion to
  /// luminance times solid angle and positions uniform in a texel (density C).
  DensitySpace density_space = DensitySpace::sine_weighted;
  LuminanceWeights weights = kRec709;  ///< of its luminance
  Lookup lookup = Lookup::nearest;     ///< whose density it claims
  /// Samples on each map: with fewer an accepting run may not have been able to see a deviation of
  /// a tenth, and is then inconclusive.
  std::uint64_t samples = std::uint64_t{1} << 20U;
  std::uint64_t seed = 1;
  /// The maps that it is tested on; sampler_test_maps() if there are none.
  std::vector<EnvironmentMap> maps = {};
};

/// Small maps that have broken samplers: a sun, black rows, one lit texel, colours, an odd size.
std::vector<EnvironmentMap> sampler_test_maps();

/// What the gate says of a sampler.
struct SamplerVerdict {
  bool is_accepted;  ///< nothing was rejected, and the samples were enough to say so
  Outcome outcome;   ///< of all tests together
  /// The table of the gate: what was rejected, by how much, what it looks like, and what an
  /// accepting run could have seen.
  std::string text;
  GateResult result;
};

/// The verdict on a sampler that is bound to each map by a function. Throws what the function
/// throws.
SamplerVerdict judge_bound_sampler(const std::string& name,
                                   const std::function<BoundSampler(const EnvironmentMap&)>& bind,
                                   const SamplerTestOptions& options);

/// A direction as a sample of the map's square. It keeps away from the edges of its texel by what
/// no rounding bridges: exactly at a pole a density per unit square would say nothing.
TexelSample sample_at(const EnvironmentMap& map, Direction direction, PerSteradian pdf);

/// A sampler as a source of samples of the map's square; the map outlives it.
template <TestableSampler Sampler>
BoundSampler bound_for_test(const EnvironmentMap& map) {
  auto sampler = std::make_shared<const Sampler>(map);
  if constexpr (DirectionSampler<Sampler>) {
    return {[sampler, &map](std::span<const SquarePoint> points, std::span<TexelSample> samples) {
              std::ranges::transform(points, samples.begin(), [&](SquarePoint u) {
                const auto sample = sampler->sample(u);
                return sample_at(map, sample.direction, sample.pdf);
              });
            },
            [sampler, &map](SquarePoint at) {
              const PerSteradian pdf = sampler->pdf(direction_at(map.mapping, at));
              return PerSquare{pdf.value * solid_angle_per_square(map.mapping, at)};
            }};
  } else {
    return {[sampler](std::span<const SquarePoint> points, std::span<TexelSample> samples) {
              std::ranges::transform(points, samples.begin(),
                                     [&](SquarePoint u) { return sampler->sample(u); });
            },
            [sampler](SquarePoint at) { return sampler->pdf(at); }};
  }
}

/// The verdict of the gate on a sampler of this type, made of each of the maps.
template <TestableSampler Sampler>
SamplerVerdict judge_sampler(const std::string& name, const SamplerTestOptions& options = {}) {
  return judge_bound_sampler(name, bound_for_test<Sampler>, options);
}

}  // namespace lightproof
