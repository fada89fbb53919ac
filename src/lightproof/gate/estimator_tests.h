// Means and variances of estimators that use the samples, against what is exact.
#pragma once

#include "lightproof/gate/draws.h"
#include "lightproof/gate/exact_checks.h"
#include "lightproof/gate/expectation.h"
#include "lightproof/gate/records.h"

namespace lightproof {

/// Why a test that weighs samples is not run.
inline constexpr const char* kNoWeights = "the samples come without densities";

/// Adds the tests of irradiance for both normals and of 1/pdf: means and variances against the
/// exact ones, means against those of uniform directions. Where the samples come without densities
/// they are recorded as not run.
void add_estimators(Records& records, const Expectation& expectation, const Inspection& inspection,
                    const Draws& draws, const UniformEstimates& uniform);

}  // namespace lightproof
