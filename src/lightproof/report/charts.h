// Vega-Lite specifications as JSON text, data included. One function per chart; widths follow the
// page ("container"), all marks are drawn as SVG.
#pragma once

#include <string>
#include <vector>

#include "lightproof/report/pareto.h"
#include "lightproof/suite/results.h"

namespace lightproof {

/// How a strategy or sampler is told apart: by colour and by shape.
struct SeriesStyle {
  std::string name;
  std::string colour;  ///< "#rrggbb"
  std::string shape;   ///< a Vega symbol: "circle", "square", …
};

/// Styles in order of first appearance; they repeat after eight names.
std::vector<SeriesStyle> series_styles(const std::vector<std::string>& names);

/// The strategies of the records, styled.
std::vector<SeriesStyle> strategy_styles(const std::vector<ConvergenceRecord>& records);

/// "receiver, material".
std::string scene_name(const ConvergenceRecord& record);

/// RMSE against samples, log-log, with lists to choose map and scene from.
std::string convergence_chart(const std::vector<ConvergenceRecord>& records);

/// The same for one map and scene, small, without a legend; the axes are those of all maps.
std::string small_convergence_chart(const std::vector<ConvergenceRecord>& records,
                                    const std::string& map, const std::string& scene);

/// Measured / predicted variance against predicted variance. Records without a ratio are left out.
std::string variance_chart(const std::vector<ConvergenceRecord>& records);

/// ns per sample against the size of the map, log-log, with the number of steps in the legend.
std::string throughput_chart(const std::vector<ThroughputRecord>& records,
                             const std::vector<GrowthFit>& growth);

/// ns per sample against another cost of the tables on the largest map, log-log, with the Pareto
/// front. Records without such a cost are left out.
std::string table_chart(const std::vector<TableRecord>& records, TableCost cost,
                        const std::string& cost_name);

}  // namespace lightproof
