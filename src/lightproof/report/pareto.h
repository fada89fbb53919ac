// Which samplers are beaten by none in two costs at once.
#pragma once

#include <vector>

#include "lightproof/results/throughput_record.h"

namespace lightproof {

/// A cost: the lower the better.
using TableCost = double TableRecord::*;

/// The records for which no other costs at most as much in both ways and less in one, by ascending
/// first cost.
std::vector<TableRecord> pareto_front(std::vector<TableRecord> records, TableCost first,
                                      TableCost second);

/// The records of the largest map among these.
std::vector<TableRecord> of_largest_map(const std::vector<TableRecord>& records);

}  // namespace lightproof
