// How far what was drawn is from its expectation, bin by bin and row by row: what a rejection
// shows.
#pragma once

#include <vector>

#include "lightproof/gate/draws.h"
#include "lightproof/gate/expectation.h"

namespace lightproof {

/// The residual (O - E) / sqrt(E) of the counts of kGateBins; O itself in a bin without
/// expectation.
Grid<double> residuals(const Expectation& expectation, const Draws& draws);

/// Pearson's divergence (O - E)^2 / E of the counts of rows, for every row the sum from t = 0 up to
/// it; a row without expectation adds O itself.
std::vector<double> cumulative_divergence(const Expectation& expectation, const Draws& draws);

}  // namespace lightproof
