// Precomputed maps on one page: every level at three exposures, with its error.
#pragma once

#include <string>

#include "lightproof/results/precomputed_map.h"

namespace lightproof {

/// One HTML document that needs nothing else. Faces of cubes are unfolded into a cross; all levels
/// of a map share the exposures, so that they can be compared.
std::string contact_sheet(const Precomputation& made);

}  // namespace lightproof
