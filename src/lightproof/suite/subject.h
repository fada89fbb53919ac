// Samplers of environment maps, before there is a map: one of the registry, a mutant, a stranger's.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "lightproof/samplers/registry.h"
#include "lightproof/suite/problem.h"

namespace lightproof {

struct Subject {
  std::string name;
  TargetDensity target;  ///< what it claims to draw; on a map, on_map() of it
  bool known_defects = false;
  /// Claims to return the texel of LinearScan for every point.
  bool inverts_shared_cdf = false;
  /// The map outlives what is bound to it. Throws InputError if the map is black.
  std::function<BoundSampler(const EnvironmentMap&)> bind;
  double resolution = 0x1p-24;  ///< as a Candidate's
  bool inverts_rows = false;    ///< likewise
  /// Of its probabilities, on a map of this size; null: it claims the declared density exactly.
  MassRounding (*rounding)(Extent map) = nullptr;
};

/// A row of the registry under one weighting.
Subject subject_of(const SamplerInfo& sampler, Weighting weighting);

/// Every sampler of the registry under both weightings.
std::vector<Subject> all_subjects();

/// Every subject on every map: a problem for each map and target density. The maps outlive them.
std::vector<Problem> problems_of(std::span<const EnvironmentMap> maps,
                                 std::span<const Subject> subjects);

}  // namespace lightproof
