// From noise to the picture: maps that are accumulated frame by frame, as a course's project shows
// them on the screen, kept after 1, 2, 4 … frames.
#pragma once

#include <cstdint>
#include <vector>

#include "lightproof/core/progress.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/precompute/request.h"
#include "lightproof/results/precomputed_map.h"

namespace lightproof {

struct SnapshotOptions {
  int frames = 64;             ///< the last one is kept as well
  int samples_per_frame = 16;  ///< for each texel
  std::uint64_t seed = 1;
};

/// The levels of the request's irradiance and reflectivity maps after 1, 2, 4 … frames, as
/// latitude-longitude maps: "irradiance-frame-16". Their samples are those of the course's shaders,
/// cosine-distributed directions and half-vectors, with the corrected weights. The errors are those
/// of check_level(), but over all texels, so that both limits are the error itself.
std::vector<PrecomputedMap> make_snapshots(const EnvironmentMap& map,
                                           const PrecomputeRequest& request,
                                           const SnapshotOptions& options,
                                           const Progress& progress = {});

}  // namespace lightproof
