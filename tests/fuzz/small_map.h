// Maps of any floats.
#pragma once

#include "lightproof/image/environment_map.h"
#include "lightproof/image/target_density.h"
#include "tests/fuzz/fuzz.h"

namespace lightproof::fuzz {

/// Which values the texels of a map have.
enum class Values {
  any,       ///< every float, also what is no radiance
  radiance,  ///< finite ones from 0 on
};

/// A map of 1 x 1 to 40 x 24 texels, of any mapping that may have so many. The values that the
/// input gives come again and again.
EnvironmentMap small_map(Input& input, Values values);

DensitySpace density_space(Input& input);

}  // namespace lightproof::fuzz
