// Charts of speed against accuracy, as Vega-Lite specifications with their data.
#pragma once

#include <string>
#include <vector>

#include "lightproof/page/chart_parts.h"
#include "lightproof/report/scene_choice.h"
#include "lightproof/results/accuracy_chart.h"
#include "lightproof/results/method_regime.h"

namespace lightproof {

/// Map, receiver and material of a chart.
SceneKey scene_of(const AccuracyChart& chart);

/// The lists to choose one of the charts by; the first that nothing occludes stands first.
/// `charts` is not empty.
SceneChoice accuracy_choice(const std::vector<AccuracyChart>& charts);

/// How a family of estimators looks, the same in every chart.
SeriesStyle family_style(EstimatorFamily family);

/// RMSE over the mean against the time of a shading point, log-log, with lists to choose from.
/// Leading lines are coloured by family, the others grey until their family is clicked in the
/// legend. Errors below 0.01 % and above 1000 % are drawn on the edge.
std::string accuracy_chart(const std::vector<AccuracyChart>& charts);

/// Fitted slopes of the estimators that draw dependent points, with bars of two standard errors,
/// with lists to choose from; empty if there are none.
std::string slope_chart(const std::vector<AccuracyChart>& charts);

/// RMSE over the mean at 64 samples, measured and predicted, against the memory that an estimator
/// keeps beside the map, with lists to choose from; empty if none keeps any.
std::string memory_chart(const std::vector<AccuracyChart>& charts);

/// The fastest method over roughness and the width of the light, as a map; a list chooses whether
/// biased ones count. `regimes` has some.
std::string regime_chart(const MethodRegimes& regimes);

}  // namespace lightproof
