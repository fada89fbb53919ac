// How often the gate calls an injected defect by its name: on the maps of a study, not on the one
// that was made for it.
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "lightproof/core/executor.h"
#include "lightproof/core/progress.h"
#include "lightproof/results/map_record.h"
#include "lightproof/results/self_test_result.h"

namespace lightproof {

/// How it is measured what mutants are called.
struct NamingOptions {
  std::uint64_t seed = 1;  ///< the first seed
  /// How many seeds in a row: on one map, a run of every mutant under every density for each.
  std::uint64_t seeds = 1;
  std::uint64_t samples = std::uint64_t{1} << 17U;

  static auto fields(auto& options) {
    return std::tie(options.seed, options.seeds, options.samples);
  }
};

/// What every mutant of maps is called under all densities on every map, with every seed. Those
/// that the gate accepts are in no count: the samples were too few, or the map lacks what the
/// defect needs.
/// The number of processes, which share the runs and all get the whole result, changes no bit.
std::vector<NamingRecord> measure_naming(std::span<const MapRecord> maps,
                                         const NamingOptions& options,
                                         const Progress& progress = {},
                                         const Communicator& communicator = {});

/// Adds what measure_naming() counted on other maps; of none at first.
void merge_naming(std::vector<NamingRecord>& records, const std::vector<NamingRecord>& others);

}  // namespace lightproof
