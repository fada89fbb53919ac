// The exact light at the pixels of a receiver, for every density that is sampled: what renders are
// held against.
#pragma once

#include <span>
#include <vector>

#include "lightproof/core/progress.h"
#include "lightproof/materials/material.h"
#include "lightproof/render/receiver.h"
#include "reference/estimator_moments.h"

namespace lightproof {

/// The kernel of the light that a point reflects, f_r (n·l)+ V, with the material's own pdf.
reference::Kernel kernel_at(const ReceiverInfo& receiver, const Scene& scene,
                            const Material& material, const ShadingPoint& point);

/// The exact moments of the estimators of luminance, as [map][pixel]; maps may differ in size.
std::vector<std::vector<reference::LightMoments>> exact_light(
    std::span<const Grid<double>> luminances, const ReceiverInfo& receiver, const Scene& scene,
    const Material& material, std::span<const Pixel> pixels);

}  // namespace lightproof
