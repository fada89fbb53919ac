// What was precomputed as a table for a terminal.
#pragma once

#include <string>

#include "lightproof/results/precomputed_map.h"

namespace lightproof {

/// A line a level: map, level, size, roughness, error with its limits if it was measured.
std::string precompute_table(const Precomputation& made);

}  // namespace lightproof
