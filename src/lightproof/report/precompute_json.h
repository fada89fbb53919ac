// What was precomputed as JSON (docs/schema/precompute.schema.json).
#pragma once

#include <string>

#include "lightproof/core/run_description.h"
#include "lightproof/results/precomputed_map.h"

namespace lightproof {

/// The version of the document that precompute_json() writes.
inline constexpr int kPrecomputeFormatVersion = 1;

/// Maps, levels, errors and files, without the pictures themselves.
std::string precompute_json(const Precomputation& made, const RunDescription& run);

}  // namespace lightproof
