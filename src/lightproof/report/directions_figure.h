// What a direction costs under each density, one at a time and in batches: part of the throughput
// section.
#pragma once

#include <string>
#include <vector>

#include "lightproof/results/throughput_record.h"

namespace lightproof {

/// A sentence that names the fastest sampler of each way to draw on maps of one size, and how the
/// densities differ.
std::string directions_finding(const std::vector<DirectionRecord>& records, Extent extent);

/// A chart of ns per direction for every sampler on maps of one size, a mark a density, one at a
/// time and in batches. Hollow marks met a busy machine.
std::string directions_chart(const std::vector<DirectionRecord>& records, Extent extent);

/// The charts of the usual size, 2048 x 1024 or what is nearest to it, and of the largest one, with
/// all records as a table and as CSV; empty if nothing was measured.
std::string directions_figure(const std::vector<DirectionRecord>& records);

}  // namespace lightproof
