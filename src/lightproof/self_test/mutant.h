// Samplers with one injected defect each: what the gate must find. `gate --sampler NAME` runs them
// like any other.
#pragma once

#include <span>
#include <string_view>

#include "lightproof/gate/alternative_distribution.h"
#include "lightproof/gate/discrete_sampler.h"
#include "lightproof/gate/sampler_under_test.h"
#include "lightproof/results/test_id.h"

namespace lightproof {

/// What differs from a correct sampler; null parts are correct.
struct Mutant {
  std::string_view name;       ///< "t-flipped-in-sample"
  std::string_view defect;     ///< what was done, in words
  std::string_view diagnosis;  ///< what the gate should say that it looks like
  Oracle oracle;               ///< the oracle that must reject it
  /// What a map must have for the defect to do harm; empty: nothing that real maps lack.
  std::string_view needs = {};
  /// What the mapping of a map must have besides what the distribution that is drawn needs.
  MappingNeed mapping_need = MappingNeed::none;
  /// An alternative distribution that is drawn, its density returned; empty: the declared one.
  std::string_view distribution = {};
  /// Whether positions inside texels are drawn uniformly in the other measure than the declared
  /// one, solid angle or (s,t).
  bool other_measure = false;
  /// The random numbers that are used in place of the i-th of a batch.
  SquarePoint (*numbers)(std::span<const SquarePoint> batch, std::size_t i) = nullptr;
  /// What is called in place of DiscreteSampler::sample.
  TexelSample (*draw)(const DiscreteSampler&, SquarePoint u) = nullptr;
  /// What is done to every sample that was drawn.
  void (*sample)(TexelSample&, const DiscreteSampler&) = nullptr;
  /// What is called in place of DiscreteSampler::pdf, for the density asked for; returned densities
  /// are not touched.
  PerSquare (*pdf)(const DiscreteSampler&, SquarePoint) = nullptr;
  /// The factor by which all densities are wrong, returned and asked for.
  double (*pdf_factor)(const DiscreteSampler&) = nullptr;
};

/// All mutants of samplers of maps, in the order in which they are shown.
std::span<const Mutant> mutants();

/// A mutant as a sampler under test, under a density; it declares Rec. 709 luminance.
SamplerUnderTest sampler_under_test(const Mutant& mutant, DensitySpace density_space);

}  // namespace lightproof
