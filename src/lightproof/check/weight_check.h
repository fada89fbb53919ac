// Given weights beside light over pdf, sample by sample.
#pragma once

#include "lightproof/dump/sample_dump.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/results/test_record.h"

namespace lightproof {

/// Holds the weights of a dump that has a pdf against L/pdf, of up to 2^22 samples that are spread
/// over it: sets what `record` says of them, which is rejected if any is off by more than
/// `tolerance`, relative, and what the rounding of a direction does. `colours` is the map of
/// coloured weights.
void check_weights(const SampleDump& dump, const EnvironmentMap& map, const EnvironmentMap& colours,
                   double tolerance, TestRecord& record);

}  // namespace lightproof
