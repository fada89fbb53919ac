// The luminance that is no weighted sum: the largest of red, green and blue.
#pragma once

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// The map as a grey one of the largest channel of every texel, whose luminance by any weights that
/// sum to 1 it is.
EnvironmentMap map_of_largest_channel(EnvironmentMap map);

}  // namespace lightproof
