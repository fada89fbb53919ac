// Defects of one texel alone: named only if the samples fit everywhere else.
#pragma once

#include "lightproof/gate/density_check.h"
#include "lightproof/gate/draws.h"
#include "lightproof/gate/expectation.h"

namespace lightproof {

/// Whether the texel that is farthest from its expectation is so by no chance, and counts of
/// texels, rows and columns fit once it and the next such one are left out.
bool is_in_one_texel(const Expectation& expectation, const Draws& draws);

/// Whether the pdf is 0 in one texel alone that should be reached, no sample lies there though some
/// were to be expected, and counts of all others fit. `density` compares the pdf with what is
/// declared.
bool is_one_texel_missing(const Expectation& expectation, const Draws& draws,
                          const DensityComparison& density);

}  // namespace lightproof
