// The samples of a dump as samples of the map's square.
#pragma once

#include <memory>
#include <vector>

#include "lightproof/dump/sample_dump.h"
#include "lightproof/gate/bound_sampler.h"
#include "lightproof/gate/density_check.h"
#include "lightproof/gate/expectation.h"

namespace lightproof {

/// A dump as a source of samples in an order of its own. A sample whose direction lies within its
/// rounding of the edge of a texel counts for the texel on either side whose declared density is
/// nearer to the sample's own, or, without a density, for the likelier one: what lies beside a sun
/// would else get samples of the sun.
BoundSampler bound_dump(std::shared_ptr<const SampleDump> dump,
                        std::shared_ptr<const Expectation> expectation);

/// Compares the density that comes with every sample, of up to 2^22 that are spread over the dump,
/// with the declared one at its place. Densities may be off by `tolerance`, relative, and by what
/// the rounding of a direction does to them.
DensityComparison compare_dumped_density(const SampleDump& dump, const Expectation& expectation,
                                         double tolerance);

/// A direction's density beside the declared one, over the square, by the texel within the rounding
/// of the direction that fits best. The direction must be one.
ComparedCell compared_at(const DumpedSample& sample, const Expectation& expectation,
                         double rounding);

/// The first `count` samples' densities beside the declared ones, of those that lie where there is
/// light.
std::vector<ComparedCell> some_densities(const SampleDump& dump, const Expectation& expectation,
                                         std::size_t count);

}  // namespace lightproof
