// The size of a deviation as people read it. JSON and CSV hold the bare numbers.
#pragma once

#include <string>

#include "lightproof/results/test_record.h"

namespace lightproof {

/// Whether the test is of the one texel, row or column that is farthest from its expectation. Its
/// effect is observed / expected - 1 of that cell alone.
bool is_of_worst_cell(const TestRecord& test);

/// The effect of a test in words: "0.0123"; of a worst cell "13.6x expected" or "never drawn".
std::string effect_text(const TestRecord& test);

/// The minimum detectable effect of a test in words: "0.0123", of a worst cell "1.2x expected"; "-"
/// if there is none.
std::string minimum_detectable_text(const TestRecord& test);

/// A p-value as a decimal number, also where a double would be 0: "0.2084", "3.16e-401".
std::string p_text(double log10_p);

}  // namespace lightproof
