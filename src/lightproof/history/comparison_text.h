// A comparison for people and programs.
#pragma once

#include <string>

#include "lightproof/history/comparison.h"

namespace lightproof {

/// Aligned columns, one line a benchmark, what went wrong first; then the rule and the totals. Ends
/// with a newline.
std::string comparison_table(const Comparison& comparison);

/// The same for a pull request.
std::string comparison_markdown(const Comparison& comparison);

/// Keys: outcome ("regressed", "suspected", "passed"), base, head, machine, compiler, flags,
/// sessions, rule, rows: [benchmark, metric, verdict, latest, earlier], where the last two are null
/// or {base, head, base_runs, head_runs, ratio, limit, noise, log10_p, change}.
std::string comparison_json(const Comparison& comparison);

}  // namespace lightproof
