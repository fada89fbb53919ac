// Defects of the random numbers alone, which leave the distribution as it is declared: each is
// named only if the samples fit what it predicts.
#pragma once

#include <string_view>

#include "lightproof/gate/draws.h"
#include "lightproof/gate/expectation.h"

namespace lightproof {

/// The defect of the random numbers that explains the samples: "coarse-numbers", "same-number",
/// "repeated-numbers" or "stratified"; empty if none of these explains the samples.
std::string_view name_of_number_defect(const Expectation& expectation, const Draws& draws);

}  // namespace lightproof
