// Everything that one study found.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lightproof/results/accuracy_chart.h"
#include "lightproof/results/convergence_record.h"
#include "lightproof/results/frame_record.h"
#include "lightproof/results/gate_result.h"
#include "lightproof/results/growth_fit.h"
#include "lightproof/results/level_cost.h"
#include "lightproof/results/map_record.h"
#include "lightproof/results/method_regime.h"
#include "lightproof/results/point_study.h"
#include "lightproof/results/published_comparison.h"
#include "lightproof/results/published_picture.h"
#include "lightproof/results/recommendation.h"
#include "lightproof/results/recommendation_survey.h"
#include "lightproof/results/render_record.h"
#include "lightproof/results/self_test_result.h"
#include "lightproof/results/split_sum_record.h"
#include "lightproof/results/stability_result.h"
#include "lightproof/results/throughput_record.h"
#include "lightproof/results/warp_grid.h"

namespace lightproof {

/// Everything that one study found.
struct StudyResult {
  std::string version;
  std::string machine;
  std::uint64_t seed = 0;
  std::vector<MapRecord> maps;
  GateResult gate;
  /// When, where and of what warps and materials went through the gate's first stage.
  std::string directions_origin;
  std::vector<ConvergenceRecord> convergence;
  std::vector<AccuracyChart> accuracy;
  std::vector<Recommendation> recommendations;
  std::vector<RefusedRecommendation> refused_recommendations = {};
  std::optional<RecommendationSurvey> recommendation_survey = {};
  MethodRegimes method_regimes = {};
  std::vector<WarpGrid> warps = {};
  std::vector<ThroughputRecord> throughput;
  std::string throughput_origin;  ///< when, where and of what the throughput was measured
  CacheSizes caches;              ///< caches of the machine that measured the throughput
  std::vector<GrowthFit> growth;
  std::vector<TableRecord> tables;
  std::vector<DirectionRecord> directions;
  std::vector<RenderRecord> renders;
  std::optional<SelfTestResult> self_test = {};
  std::vector<PublishedComparison> published_forms = {};
  std::vector<FrameErrorRecord> frames = {};
  PointStudy points = {};
  LevelCosts level_costs = {};
  std::vector<PublishedPicture> published_pictures = {};
  std::vector<SplitSumRecord> split_sum = {};
  StabilityResult stability = {};
};

}  // namespace lightproof
