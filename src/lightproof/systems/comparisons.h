// The published forms that are wrong or incomplete, beside the corrected ones and exact values.
#pragma once

#include <tuple>
#include <vector>

#include "lightproof/core/kept_measurement.h"
#include "lightproof/core/progress.h"
#include "lightproof/results/published_comparison.h"
#include "lightproof/results/published_picture.h"

namespace lightproof {

/// The comparisons of all systems, in the order of their ids: each on an input whose exact result
/// is known.
std::vector<PublishedComparison> system_comparisons();

/// Pictures of those that are worth looking at, in the same order.
std::vector<PublishedPicture> system_pictures(const Progress& progress = {});

/// Both.
struct PublishedForms {
  std::vector<PublishedComparison> comparisons;
  std::vector<PublishedPicture> pictures;

  static auto fields(auto& all) { return std::tie(all.comparisons, all.pictures); }
};

/// Both, or what is kept of them, of this program: nothing that a user gives changes them.
PublishedForms kept_published_forms(const MeasurementCache& cache, const Progress& progress = {});

}  // namespace lightproof
