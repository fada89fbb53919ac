// The published forms that are wrong or incomplete, beside the corrected ones and exact values.
#pragma once

#include <vector>

#include "lightproof/core/progress.h"
#include "lightproof/results/published_comparison.h"
#include "lightproof/results/published_picture.h"

namespace lightproof {

/// The comparisons of all systems, in the order of their ids: each on an input whose exact result
/// is known.
std::vector<PublishedComparison> system_comparisons();

/// Pictures of those that are worth looking at, in the same order.
std::vector<PublishedPicture> system_pictures(const Progress& progress = {});

}  // namespace lightproof
