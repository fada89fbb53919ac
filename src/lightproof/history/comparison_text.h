// A comparison for people and programs.
#pragma once

#include <string>

#include "lightproof/core/run_description.h"
#include "lightproof/history/comparison.h"

namespace lightproof {

/// A comparison for a terminal: aligned columns, one line a benchmark, what went wrong first; then
/// the rule and the totals. Ends with a newline.
std::string comparison_table(const Comparison& comparison);

/// A comparison as Markdown for a pull request: a table of benchmarks, what went wrong first, the
/// rule and the totals.
std::string comparison_markdown(const Comparison& comparison);

/// A comparison as GitHub workflow commands: an error for each measurement that regressed and a
/// warning for each that is suspected, nine of each at most, and the numbers of the others.
std::string comparison_annotations(const Comparison& comparison);

/// Version of the format of comparison_json() (docs/schema/comparison.schema.json).
inline constexpr int kComparisonFormatVersion = 1;

/// A comparison as JSON, every row of it; the keys are described in
/// docs/schema/comparison.schema.json. Of `run` it takes version, commit and command.
std::string comparison_json(const Comparison& comparison, const RunDescription& run);

}  // namespace lightproof
