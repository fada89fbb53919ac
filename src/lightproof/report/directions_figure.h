// What a direction costs under each density, one at a time and in batches: part of the throughput
// section.
#pragma once

#include <string>
#include <vector>

#include "lightproof/results/throughput_record.h"

namespace lightproof {

/// A sentence that names the fastest sampler of each way to draw, and how the densities differ.
std::string directions_finding(const std::vector<DirectionRecord>& records);

/// A chart of ns per direction for every sampler, a mark a density, one at a time and in batches.
std::string directions_chart(const std::vector<DirectionRecord>& records);

/// The chart with its table and its numbers as CSV; empty if nothing was measured.
std::string directions_figure(const std::vector<DirectionRecord>& records);

}  // namespace lightproof
