// What is wrong with samples that no known defect explains, in one sentence.
#pragma once

#include <string>

#include "lightproof/gate/diagnosis.h"

namespace lightproof {

/// Describes what is wrong with rejected samples: the stretch of rows, of columns or the texel that
/// is farthest from its expectation, by how much and in which direction; where the counts are
/// right, the rejected test that is farthest off.
std::string describe_deviation(const Expectation& expectation, const Evidence& evidence);

}  // namespace lightproof
