// Warps and material samplers with one injected defect each.
#pragma once

#include <string_view>
#include <vector>

#include "lightproof/gate/direction_sampler.h"
#include "lightproof/results/test_id.h"

namespace lightproof {

/// A sampler of directions with one injected defect.
struct DirectionMutant {
  /// Its description names the defect, its distribution is the claim.
  DirectionSamplerInfo sampler;
  std::string_view diagnosis;  ///< what the gate should say that it looks like
  Oracle oracle;               ///< the oracle that must reject it
};

/// All mutants of warps and materials.
std::vector<DirectionMutant> direction_mutants();

/// The samplers of direction_mutants().
std::vector<DirectionSamplerInfo> direction_mutant_samplers();

}  // namespace lightproof
