// What materials claim to draw, as reference/ has it.
#pragma once

#include "lightproof/gate/direction_distribution.h"
#include "lightproof/materials/material.h"

namespace lightproof {

/// The distribution of the directions that a material draws where the normal is +z and the view a
/// unit vector above.
DirectionDistribution distribution_of(const Material& material, Direction view);

}  // namespace lightproof
