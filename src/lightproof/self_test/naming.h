// How often the gate calls an injected defect by its name: on the maps of a study, not on the one
// that was made for it.
#pragma once

#include <span>
#include <vector>

#include "lightproof/core/progress.h"
#include "lightproof/results/map_record.h"
#include "lightproof/results/self_test_result.h"

namespace lightproof {

/// How it is measured what mutants are called.
struct NamingOptions {
  std::uint64_t seed = 1;   ///< the first seed
  std::uint64_t seeds = 3;  ///< how many seeds in a row
  std::uint64_t samples = std::uint64_t{1} << 17U;
};

/// What every mutant of maps is called under both densities on every map, with every seed. Those
/// that the gate accepts are in no count: the samples were too few, or the map lacks what the
/// defect needs.
std::vector<NamingRecord> measure_naming(std::span<const MapRecord> maps,
                                         const NamingOptions& options,
                                         const Progress& progress = {});

}  // namespace lightproof
