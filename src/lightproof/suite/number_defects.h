// Defects of the random numbers alone, which leave the law as it is declared: each is named only if
// the samples fit what it predicts.
#pragma once

#include <string_view>

#include "lightproof/suite/draws.h"
#include "lightproof/suite/expectation.h"

namespace lightproof {

/// "coarse-numbers", "same-number", "repeated-numbers" or "stratified"; empty if none of these
/// explains the samples.
std::string_view name_of_number_defect(const Expectation& expectation, const Draws& draws);

}  // namespace lightproof
