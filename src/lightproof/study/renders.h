// Pictures by every estimator at equal numbers of samples, beside a reference.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightproof/core/progress.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/results/render_record.h"

namespace lightproof {

/// How pictures are rendered.
struct RenderOptions {
  std::uint64_t seed = 1;
  Extent picture = {160, 120};
  std::uint64_t samples = 64;              ///< samples per pixel of each estimator
  std::uint64_t reference_samples = 2048;  ///< samples per pixel of the reference, environment B
};

/// Renders the sphere on a plane, of modified Phong, under every map by every estimator.
std::vector<RenderRecord> study_renders(std::span<const EnvironmentMap> maps,
                                        const RenderOptions& options,
                                        const Progress& progress = {});

}  // namespace lightproof
