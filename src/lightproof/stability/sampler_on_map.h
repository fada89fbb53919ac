// A sampler on a map, with what it ought to draw there, and what is found wrong with what it draws.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/gate/expectation.h"
#include "lightproof/stability/stability_case.h"

namespace lightproof {

/// A sampler on a map, and what it ought to draw there.
class SamplerOnMap {
 public:
  /// Throws InputError if the sampler refuses the map, or the map is black.
  SamplerOnMap(const SamplerUnderTest& method, EnvironmentMap map);
  SamplerOnMap(const SamplerOnMap&) = delete;
  SamplerOnMap& operator=(const SamplerOnMap&) = delete;

  const EnvironmentMap& map() const { return map_; }
  Extent extent() const { return map_.radiance.extent(); }
  const BoundSampler& sampler() const { return sampler_; }
  const Expectation& exact() const { return exact_; }
  const MassRounding& rounding() const { return rounding_; }
  std::vector<TexelSample> at(std::span<const SquarePoint> points) const;
  /// Whether the declared density is positive where a sample lies.
  bool is_lit(const TexelSample& sample) const;

 private:
  EnvironmentMap map_;
  BoundSampler sampler_;
  Expectation exact_;
  MassRounding rounding_;
};

/// Whether a sample lies on a map of this size: texel and position.
bool is_inside(const TexelSample& sample, Extent extent);

/// "u = (0.5, 0.25)".
std::string point_text(SquarePoint u);
/// "texel (3, 4) at (0.2, 0.6), density 1.5".
std::string sample_text(const TexelSample& sample);

/// How many samples fail in what way, with the first of the worst as the example.
class SampleTally {
 public:
  /// The points at which the samples were drawn.
  explicit SampleTally(std::span<const SquarePoint> points) : points_(points) {}

  /// Sample i, at point i, fails.
  void add(StabilityOutcome outcome, std::size_t i, const TexelSample& sample,
           std::string_view what);
  /// The worst that was added; its amount is the share of the points that failed.
  Finding finding() &&;

 private:
  std::span<const SquarePoint> points_;
  std::size_t failed_ = 0;
  Finding finding_;
};

/// What is wrong with samples, whatever the map: numbers that are none, texels that are none. The
/// points are those at which they were drawn.
Finding check_samples(std::span<const SquarePoint> points, std::span<const TexelSample> samples,
                      Extent extent);

/// What is wrong with samples, and whether every one lies in a texel with light and has a positive
/// density.
Finding check_drawn(const SamplerOnMap& on_map, std::span<const SquarePoint> points);

/// Whether the density is the declared one at every texel, within the rounding that the sampler
/// declares; the amount is the largest relative error, or the light that cannot be reached.
Finding check_density(const SamplerOnMap& on_map);

/// Which columns of a row a monotone sampler reaches by u.s = k `step`, all k below 1/step; none if
/// no number that was tried leads to the row.
std::vector<bool> reached_columns(const SamplerOnMap& on_map, int row, double step);

/// The share of the random numbers u.s that lead to another column of row 0 than the exact one, of
/// a sampler in which columns follow each other: how far its CDF entries lie from the exact ones,
/// in steps of `step`. Of at most 256 entries, for all of them.
double misplaced_share(const SamplerOnMap& on_map, double step);

/// The share of a map's light, that of its brightest texel left out, in texels that are never
/// drawn: their density is 0, or no random number leads to them, in the steps of the sums that the
/// method searches.
double lost_sky(const SamplerUnderTest& method, const SamplerOnMap& on_map);

/// The worse of two findings: what is no number before what does not exist before what is wrong; of
/// equals the first, with the larger amount.
Finding worse_of(Finding a, Finding b);

}  // namespace lightproof
