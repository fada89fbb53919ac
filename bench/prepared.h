// Samplers that were built and checked before they are timed.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "lightproof/core/measure.h"
#include "lightproof/samplers/registry.h"

namespace lightproof::bench {

/// Uniform points, 2^21, the same in every run.
std::span<const SquarePoint> random_points();

/// The points at which samples are drawn that are to fit the map.
std::span<const SquarePoint> points_of_fit();

/// An explanation if samples, drawn at points_of_fit(), do not fit the reference's bins of the
/// benchmarks' map; empty if they do.
std::string misfit_of(std::span<const TexelSample> samples, TargetDensity target, Extent extent);

/// The largest relative difference between the probability with which a texel of the benchmarks'
/// map is drawn and its share of the light. `pdf` is the density over the square that the sampler
/// says it draws with. Of texels without light, which are drawn by none.
double worst_texel_error(Extent extent, TargetDensity target,
                         const std::function<double(SquarePoint)>& pdf);

/// Whether a sampler draws whole texels, with the probability that it says.
bool draws_texels(const SamplerInfo& info);

struct Prepared {
  std::optional<AnySampler> sampler;
  double build_ms = 0.0;           ///< median of some builds, on all threads
  double worst_texel_error = 0.0;  ///< if it draws whole texels
  std::string why_not;             ///< what is wrong with the samples; empty if nothing is
};

/// The sampler of the benchmarks' map of this size, by default under the lecture's density. It is
/// built some times and checked once, though Google Benchmark runs a benchmark several times, and
/// stays until another is asked for. Its samples must fit the bins of reference/, one at a time and
/// in batches; if it searches sums, its texels must be those of reference/.
const Prepared& prepared(const SamplerInfo& info, Extent extent,
                         DensitySpace density_space = DensitySpace::texture);

}  // namespace lightproof::bench
