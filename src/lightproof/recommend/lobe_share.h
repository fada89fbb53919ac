// How wide a material's lobe is, as a share of the sphere.
#pragma once

#include "lightproof/materials/material.h"

namespace lightproof {

/// The part of the sphere that the material's lobe fills: (∫ρ)^2 / ∫ρ^2 over 4 pi, of ρ = f_r
/// (n·l)+ seen along the normal; 1 if ρ were the same everywhere. By midpoints in the logarithm of
/// the angle to the normal, to 1e-3.
double lobe_share(const Material& material);

}  // namespace lightproof
