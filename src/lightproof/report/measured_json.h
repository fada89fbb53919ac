// What a study measures beside the samplers, as JSON: frames, point sets, costs of levels.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "lightproof/results/frame_record.h"
#include "lightproof/results/level_cost.h"
#include "lightproof/results/point_study.h"

namespace lightproof {

nlohmann::ordered_json frames_json(const std::vector<FrameErrorRecord>& frames);
nlohmann::ordered_json points_json(const PointStudy& points);
nlohmann::ordered_json level_costs_json(const LevelCosts& costs);

}  // namespace lightproof
