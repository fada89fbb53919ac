// The gate's verdicts as text for a terminal.
#pragma once

#include <string>

#include "lightproof/results/gate_result.h"

namespace lightproof {

/// Whether text is coloured, by ANSI escape sequences.
enum class Colour { off, ansi };

/// The verdicts as a table in aligned columns: one line per sampler, density and map with its worst
/// test, then every rejected test in full, then the totals of the tests that count (see
/// overall_outcome), and what an accepting run could have seen. Samplers with known defects that do
/// not count stand before that in a section of their own. Ends with a newline.
std::string gate_table(const GateResult& gate, bool count_known_defects,
                       Colour colour = Colour::off);

}  // namespace lightproof
