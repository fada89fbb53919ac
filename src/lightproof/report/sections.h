// The parts of the page, each as markup, in the order in which they stand.
#pragma once

#include <string>

#include "lightproof/results/study_result.h"

namespace lightproof {

/// The verdict in one line.
std::string opening_section(const StudyResult& study);
/// The chart that the report opens with; empty without charts.
std::string accuracy_section(const std::vector<AccuracyChart>& charts);
/// The cheapest method for each map; empty without recommendations and charts.
std::string recommendation_section(const StudyResult& study);
/// What was found, in sentences, and how to read the rest.
std::string overview_section(const StudyResult& study);
/// What else follows from the charts of speed against accuracy.
std::string methods_section(const StudyResult& study);
/// `directions_origin`: of the tests of warps and materials; empty if it is not known.
std::string gate_section(const GateResult& gate, const std::string& directions_origin);
std::string self_test_section(const std::optional<SelfTestResult>& self_test);
std::string map_section(const std::vector<MapRecord>& maps);
std::string convergence_section(const std::vector<ConvergenceRecord>& records);
std::string variance_section(const std::vector<ConvergenceRecord>& records);
std::string throughput_section(const StudyResult& study);
std::string render_section(const std::vector<RenderRecord>& renders);
std::string frame_section(const std::vector<FrameErrorRecord>& frames);
std::string point_section(const PointStudy& points);
std::string level_cost_section(const LevelCosts& costs);
std::string stability_section(const StabilityResult& stability);
std::string split_sum_section(const std::vector<SplitSumRecord>& records);
std::string published_section(const std::vector<PublishedComparison>& comparisons,
                              const std::vector<PublishedPicture>& pictures);

}  // namespace lightproof
