// What charts of speed against accuracy say, in sentences.
#pragma once

#include <string>
#include <vector>

#include "lightproof/results/accuracy_chart.h"
#include "lightproof/results/method_regime.h"

namespace lightproof {

/// The error that every chart is read at: 5 %.
inline constexpr double kUsualError = 0.05;

/// Which estimator reaches 5 % and 1 % first, when, and how much longer uniform sampling takes.
std::string accuracy_finding(const AccuracyChart& chart);

/// What is on the Pareto front, from fast to exact, each estimator once.
std::string front_sentence(const AccuracyChart& chart);

/// How many estimators are charted, how many errors could not be measured, and what is off because
/// it ignores what blocks the light.
std::string accuracy_caveats(const AccuracyChart& chart);

/// Which families win in how many of the cells. `regimes` has some.
std::string regime_finding(const MethodRegimes& regimes);

/// The alias tables and the monotone ones with the same points, by their fitted slopes.
std::string slope_finding(const AccuracyChart& chart);

/// The smallest table of the map whose error at 64 samples is within a tenth of the best one's.
std::string memory_finding(const AccuracyChart& chart);

}  // namespace lightproof
