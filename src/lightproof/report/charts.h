// Vega-Lite specifications as JSON text, data included. One function per chart; widths follow the
// page ("container"), all marks are drawn as SVG.
#pragma once

#include <string>
#include <vector>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/html.h"
#include "lightproof/report/pareto.h"
#include "lightproof/results/study_result.h"

namespace lightproof {

/// The styles of the estimators of the records.
std::vector<SeriesStyle> estimator_styles(const std::vector<ConvergenceRecord>& records);

/// The scene of a record in words: "receiver, material".
std::string scene_name(const ConvergenceRecord& record);

/// A chart of RMSE against samples, log-log, with lists to choose map and scene from.
std::string convergence_chart(const std::vector<ConvergenceRecord>& records);

/// What that chart is headed by, for each map and scene; first the one that is shown first: where
/// most slopes could be fitted.
std::vector<ChartTitle> convergence_titles(const std::vector<ConvergenceRecord>& records);

/// A small chart of RMSE against samples, log-log, for one map and scene, without a legend; the
/// axes are those of all maps.
std::string small_convergence_chart(const std::vector<ConvergenceRecord>& records,
                                    const std::string& map, const std::string& scene);

/// A heat map of the split sum's error over roughness and view angle, with its numbers, and lists
/// to choose map and reflectance from. `records` is not empty.
std::string split_sum_chart(const std::vector<SplitSumRecord>& records);

/// A small one of one map and reflectance, with the same colours.
std::string small_split_sum_chart(const std::vector<SplitSumRecord>& records);

/// A chart of measured / predicted variance against predicted variance. Records without a ratio are
/// left out.
std::string variance_chart(const std::vector<ConvergenceRecord>& records);

/// A chart of ns per sample against the size of the map, log-log, with the fitted growth in the
/// legend. Points at which a table leaves a cache, and measured breakpoints, are framed.
std::string throughput_chart(const StudyResult& study);

/// A chart of ns per sample against the bytes of the tables on the largest map, log-log; the size
/// of a mark tells the worst texel's error; rings around what nothing beats in all three.
std::string table_chart(const std::vector<TableRecord>& records);

}  // namespace lightproof
