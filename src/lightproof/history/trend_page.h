// The history as a page.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lightproof/history/trend.h"

namespace lightproof {

/// The trends as one self-contained HTML document: a chart per line, with its levels and changes,
/// the changes as a table, all points as CSV. `lines` in the order of trend_lines().
std::string trend_page(std::span<const TrendLine> lines, std::string_view version);

/// The chart of one line as a Vega-Lite specification, in JSON.
std::string trend_chart(const TrendLine& line);

}  // namespace lightproof
