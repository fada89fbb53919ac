// Maps for real-time rendering, all that were asked for, with their errors.
#pragma once

#include <cstdint>

#include "lightproof/core/progress.h"
#include "lightproof/core/unfinished_work.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/precompute/request.h"
#include "lightproof/results/precomputed_map.h"

namespace lightproof {

/// What is measured beside the making.
struct CheckOptions {
  std::size_t texels = 0;  ///< of each level, drawn at random; 0: nothing is measured
  std::uint64_t seed = 1;
};

/// Makes what is asked for. Levels and BRDF maps that `unfinished` has are taken from there, and
/// new ones kept there: it must be of these inputs_of(). Throws InputError for sizes and numbers of
/// levels that no map may have.
Precomputation precompute(const EnvironmentMap& map, const PrecomputeRequest& request,
                          const UnfinishedWork& unfinished, const CheckOptions& check,
                          const Progress& progress = {});

/// The largest error of all levels and of the BRDF map; none if nothing was measured.
std::optional<double> largest_error(const Precomputation& made);

}  // namespace lightproof
