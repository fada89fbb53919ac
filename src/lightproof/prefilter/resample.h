// A map at another size.
#pragma once

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"

namespace lightproof {

/// Every texel is the mean of the map over the texel's own solid angle: no light is lost or made.
/// The map itself, if the size is its own.
Grid<Rgb> resampled(const Grid<Rgb>& map, Extent extent);

}  // namespace lightproof
