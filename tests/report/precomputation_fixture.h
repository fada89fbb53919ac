// A made-up precomputation for tests of its page: a latitude-longitude map, a cube and a BRDF
// integration map, with and without errors, and names that are markup.
#pragma once

#include "lightproof/results/precomputed_map.h"

namespace lightproof::testing {

Precomputation synthetic_precomputation();

}  // namespace lightproof::testing
