// What a study measures beside the samplers, as CSV, RFC 4180: frames, point sets, costs of levels.
#pragma once

#include <string>
#include <vector>

#include "lightproof/results/frame_record.h"
#include "lightproof/results/level_cost.h"
#include "lightproof/results/point_study.h"

namespace lightproof {

/// One row for each construction, precision, pole and distance.
std::string frames_csv(const std::vector<FrameErrorRecord>& frames);
/// One row for each set, integrand and number of points.
std::string point_errors_csv(const std::vector<PointRate>& rates);
/// One row for each set and number of points.
std::string discrepancy_csv(const std::vector<PointDiscrepancy>& discrepancies);
/// One row for each set and window.
std::string decay_csv(const std::vector<PointDecay>& decay);
/// One row for each map, level, method and setting.
std::string level_costs_csv(const std::vector<LevelCost>& levels);
/// One row for each kind of work.
std::string thread_gains_csv(const std::vector<ThreadGain>& gains);

}  // namespace lightproof
