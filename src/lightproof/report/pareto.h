// Which samplers' tables are beaten by none in time, memory and accuracy at once.
#pragma once

#include <vector>

#include "lightproof/results/throughput_record.h"

namespace lightproof {

/// The records for which no other is at most as slow, as large and as wrong, and less of one of
/// these; the fastest first.
std::vector<TableRecord> unbeaten_tables(const std::vector<TableRecord>& records);

/// The records of the largest map among these.
std::vector<TableRecord> of_largest_map(const std::vector<TableRecord>& records);

}  // namespace lightproof
