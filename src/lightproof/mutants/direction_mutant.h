// Warps and material samplers with one planted defect each.
#pragma once

#include <string_view>
#include <vector>

#include "lightproof/suite/direction_sampler.h"

namespace lightproof {

struct DirectionMutant {
  DirectionSampler sampler;    ///< its description names the defect, its law is the claim
  std::string_view diagnosis;  ///< what the gate should say that it looks like
  std::string_view oracle;     ///< the oracle that must reject it
};

std::vector<DirectionMutant> direction_mutants();

/// The samplers alone.
std::vector<DirectionSampler> direction_mutant_samplers();

}  // namespace lightproof
