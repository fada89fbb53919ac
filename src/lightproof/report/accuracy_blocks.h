// Charts of speed against accuracy as tables of the page.
#pragma once

#include <string>
#include <vector>

#include "lightproof/results/accuracy_chart.h"

namespace lightproof {

/// What stands below the chart of one place: at equal error, at equal time, set-up and memory, and
/// what was left out; each folded.
std::string accuracy_tables_html(const AccuracyChart& chart);

/// Samples to 5 % error, a row for each estimator, a column for each chart; folded.
std::string samples_table_html(const std::vector<AccuracyChart>& charts);

/// The fastest to 5 % error, a row for each receiver and material, a column for each map.
std::string winners_table_html(const std::vector<AccuracyChart>& charts);

}  // namespace lightproof
