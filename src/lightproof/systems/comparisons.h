// The published forms that are wrong or incomplete, beside the corrected ones and exact values.
#pragma once

#include <vector>

#include "lightproof/results/published_comparison.h"

namespace lightproof {

/// Of all systems, in the order of their ids: each on an input whose exact result is known.
std::vector<PublishedComparison> system_comparisons();

}  // namespace lightproof
