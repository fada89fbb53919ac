// Pictures by estimators of many kinds in equal time, beside a reference.
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
  Extent picture = {128, 96};
  double point_seconds = 16e-6;            ///< processor time of a pixel that each estimator has
  std::uint64_t reference_samples = 1024;  ///< samples per pixel of the reference
  bool every_estimator = false;            ///< all that serve a material, not one of each kind
};

/// Renders a glossy sphere on a plane and a diffuse sphere under every map, by estimators that
/// serve the material, one of each kind or all, with as many samples as take the time that all
/// have. How many these are is measured: pictures depend on the machine. One that its samples do
/// not matter to takes its own time.
std::vector<RenderRecord> study_renders(std::span<const EnvironmentMap> maps,
                                        const RenderOptions& options,
                                        const Progress& progress = {});

}  // namespace lightproof
