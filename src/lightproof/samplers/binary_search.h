// Inversion by bisection (std::upper_bound): O(log W + log H) per sample, texel for texel the
// same as LinearScan.
#pragma once

#include "lightproof/samplers/cdf_inversion.h"

namespace lightproof {

/// Halves the range.
int search_by_bisection(CdfKnots knots, std::uint32_t u);

using BinarySearch = CdfInversion<search_by_bisection>;

}  // namespace lightproof
