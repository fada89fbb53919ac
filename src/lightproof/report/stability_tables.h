// What hard inputs made of methods, as text for a terminal and as CSV.
#pragma once

#include <string>
#include <vector>

#include "lightproof/results/stability_result.h"

namespace lightproof {

/// How many methods of a case passed, failed and so on.
struct StabilityTally {
  int passed = 0;    ///< right, or refused where that is required
  int failed = 0;    ///< of those with known defects, and of those that cannot by their nature
  int broken = 0;    ///< claims that were not kept
  int left_out = 0;  ///< methods that promise nothing of the kind
};
StabilityTally tally_of(const std::vector<StabilityRecord>& records);

/// The matrix, a line for each method and a column for each case: "." right, "W" wrong, "N" not a
/// number, "O" out of range, "r" refused as required, "R" refused, "-" not applicable. One table a
/// kind of method; then what failed, in words; then the breaking points.
std::vector<std::string> stability_lines(const StabilityResult& stability);

/// One line: how many methods there are, and how many keep what they claim.
std::string stability_verdict(const StabilityResult& stability);

/// The interval of a breaking point in words: "between 1.2e6 and 1.3e6", "none up to 1e12".
std::string interval_text(const BreakingPoint& point);

/// One row for each case, kind and method.
std::string stability_csv(const std::vector<StabilityRecord>& records);
/// One row for each quantity and method.
std::string breaking_points_csv(const std::vector<BreakingPoint>& points);

}  // namespace lightproof
