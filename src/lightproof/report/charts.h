// Vega-Lite specifications as JSON text, data included. One function per chart; widths follow the
// page ("container"), all marks are drawn as SVG.
#pragma once

#include <string>
#include <vector>

#include "lightproof/page/chart_parts.h"
#include "lightproof/report/pareto.h"
#include "lightproof/results/study_result.h"

namespace lightproof {

/// The estimators of the records, styled.
std::vector<SeriesStyle> estimator_styles(const std::vector<ConvergenceRecord>& records);

/// "receiver, material".
std::string scene_name(const ConvergenceRecord& record);

/// RMSE against samples, log-log, with lists to choose map and scene from.
std::string convergence_chart(const std::vector<ConvergenceRecord>& records);

/// The same for one map and scene, small, without a legend; the axes are those of all maps.
std::string small_convergence_chart(const std::vector<ConvergenceRecord>& records,
                                    const std::string& map, const std::string& scene);

/// Measured / predicted variance against predicted variance. Records without a ratio are left out.
std::string variance_chart(const std::vector<ConvergenceRecord>& records);

/// ns per sample against the size of the map, log-log, with the fitted growth in the legend. Points
/// at which a table leaves a cache, and measured breakpoints, are framed.
std::string throughput_chart(const StudyResult& study);

/// ms of a build against the number of texels, likewise, without frames: a build reads the map from
/// end to end, and waits for no cache. Records without such a time are left out.
std::string build_chart(const StudyResult& study);

/// ns per sample against another cost of the tables on the largest map, log-log, with the Pareto
/// front. Records without such a cost are left out.
std::string table_chart(const std::vector<TableRecord>& records, TableCost cost,
                        const std::string& cost_name);

}  // namespace lightproof
