#include "lightproof/report/json.h"

#include <nlohmann/json.hpp>

#include "lightproof/report/accuracy_tables.h"
#include "lightproof/report/ci_outputs.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/gate_summary.h"
#include "lightproof/report/json_number.h"
#include "lightproof/report/measured_json.h"
#include "lightproof/report/names.h"
#include "lightproof/report/recommendation_json.h"
#include "lightproof/report/stability_json.h"

namespace lightproof {
namespace {

using Json = nlohmann::ordered_json;

using json_parts::number;

Json json_of(Extent extent) { return json_parts::size(extent); }

Json json_of(const FittedExponent& fit) {
  return {{"value", number(fit.value)}, {"error", number(fit.error)}};
}

Json json_of(const SegmentedGrowth& breakpoints) {
  Json list = Json::array();
  for (const GrowthBreakpoint& breakpoint : breakpoints.breakpoints) {
    list.push_back({{"size", json_of(breakpoint.extent)},
                    {"exponent_after", number(breakpoint.exponent_after)}});
  }
  return {{"exponent_before", number(breakpoints.exponent_before)},
          {"breakpoints", list},
          {"p_value", number(breakpoints.p_value)}};
}

/// null if there is none.
template <class Value>
Json json_of(const std::optional<Value>& value) {
  return value ? json_of(*value) : Json(nullptr);
}

Json json_of(const PublishedComparison& c) {
  return {{"system", c.system},
          {"quantity", c.what},
          {"exact", number(c.exact)},
          {"published", number(c.published)},
          {"corrected", number(c.corrected)}};
}

Json json_of(const PublishedPicture& p) {
  return {{"system", p.system},
          {"what", p.what},
          {"size", json_of(p.exact.extent())},
          {"published_rmse", number(p.published_rmse)},
          {"corrected_rmse", number(p.corrected_rmse)},
          {"noise", number(p.noise)}};
}

Json json_of(const SplitSumRecord& r) {
  return {{"map", r.map},
          {"normal_reflectance", number(r.normal_reflectance)},
          {"roughness", number(r.roughness)},
          {"view_degrees", number(view_degrees(r))},
          {"rmse", number(r.rmse)},
          {"left_out", number(r.left_out)}};
}

Json json_of(const TestRecord& t) {
  return {{"sampler", t.sampler},
          {"density", t.density_space},
          {"map", t.map},
          {"oracle", to_string(describe(t.test).oracle)},
          {"test", describe(t.test).name},
          {"samples", t.samples},
          {"statistic", number(t.statistic)},
          {"dof", t.dof > 0.0 ? number(t.dof) : Json(nullptr)},
          {"log10_p", number(t.log10_p)},
          {"effect", number(t.effect)},
          {"minimum_detectable_effect", number(t.minimum_detectable_effect)},
          {"resolution_floor", number(t.resolution_floor)},
          {"outcome", to_string(t.outcome)},
          {"known_defect", t.known_defect},
          {"stage", t.stage},
          {"seed", t.seed},
          {"detail", t.detail}};
}

// Declared here so that list_of finds them all.
Json json_of(const GateResult& gate, const Rejection& r);
Json json_of(const Recognition& r);
Json json_of(const ConvergencePoint& p);
Json json_of(const ConvergenceRecord& r);
Json json_of(const ThroughputRecord& r);
Json json_of(const TableRecord& r);
Json json_of(const DirectionRecord& r);
Json json_of(const GrowthFit& fit);
Json json_of(const StepTime& step);
Json json_of(const MapRecord& r);
Json json_of(const RenderRecord& r);
Json json_of(const CalibrationRecord& r);
Json json_of(const FamilyRecord& r);
Json json_of(const PowerRecord& r);
Json json_of(const KillRecord& r);
Json json_of(const NamingRecord& r);

template <class Record>
Json list_of(const std::vector<Record>& records) {
  Json list = Json::array();
  for (const Record& record : records) list.push_back(json_of(record));
  return list;
}

Json rejections_json(const GateResult& gate) {
  Json list = Json::array();
  for (const Rejection& rejection : gate.rejections) list.push_back(json_of(gate, rejection));
  return list;
}

Json left_out_json(const std::vector<LeftOut>& left_out) {
  Json list = Json::array();
  for (const LeftOut& each : left_out) {
    list.push_back({{"sampler", each.sampler},
                    {"density", each.density_space},
                    {"map", each.map},
                    {"reason", each.reason}});
  }
  return list;
}

/// What the gate says of itself in its own document and in a study's.
Json json_of(const GateResult& gate, GateVerdict verdict) {
  const SplitGate split = split_gate(gate, verdict.count_known_defects);
  return {{"outcome", to_string(verdict.overall)},
          {"family_alpha", number(gate.family_alpha)},
          {"samples", gate.samples},
          {"seed", gate.seed},
          {"tests", list_of(gate.tests)},
          {"rejections", rejections_json(split.deciding)},
          {"known_defects", rejections_json(split.known_defects)},
          {"left_out", left_out_json(gate.left_out)},
          {"recognised", list_of(gate.recognitions)}};
}

/// Documents that others have written already.
Json parsed(const std::vector<std::string>& documents) {
  Json list = Json::array();
  for (const std::string& document : documents) list.push_back(Json::parse(document));
  return list;
}

Json commit_of(const RunDescription& run) {
  return run.commit.empty() ? Json(nullptr) : Json(run.commit);
}

Json json_of(const Recognition& r) {
  return {{"words", r.words}, {"options", r.options}, {"log10_p", number(r.log10_p)}};
}

Json json_of(const GateResult& gate, const Rejection& r) {
  Json worst = Json::array();
  for (const WorstBin& bin : worst_bins(r, 20)) {
    worst.push_back({{"column", bin.x}, {"row", bin.y}, {"residual", number(bin.residual)}});
  }
  return {{"sampler", r.sampler},
          {"density", r.density_space},
          {"map", r.map},
          {"looks_like", r.looks_like},
          {"diagnosis", r.diagnosis},
          {"confidence", r.confidence},
          {"worst_bins", worst},
          {"cumulative_row_divergence", r.row_divergence},
          {"replay", replay_command(gate, r)}};
}

Json json_of(const ConvergencePoint& p) {
  return {{"samples", p.samples},
          {"rmse", number(p.rmse)},
          {"rmse_error", number(p.rmse_error)},
          {"predicted", number(p.predicted)}};
}

Json json_of(const ConvergenceRecord& r) {
  return {{"map", r.map},
          {"receiver", r.receiver},
          {"material", r.material},
          {"estimator", r.estimator},
          {"pixels", r.pixels},
          {"replicates", r.replicates},
          {"points", list_of(r.points)},
          {"slope", number(r.slope)},
          {"slope_error", number(r.slope_error)},
          {"measured_variance", number(r.measured_variance)},
          {"predicted_variance", number(r.predicted_variance)},
          {"variance_ratio_error", number(r.variance_ratio_error)}};
}

Json json_of(const ThroughputRecord& r) {
  return {{"sampler", r.sampler},
          {"map", r.map},
          {"size", json_of(r.extent)},
          {"ns_per_sample", number(r.ns_per_sample)},
          {"ns_low", number(r.ns_low)},
          {"ns_high", number(r.ns_high)},
          {"table_bytes", number(r.table_bytes)},
          {"build_ms", number(r.build_ms)},
          {"wall_per_cpu", number(r.wall_per_cpu)}};
}

Json json_of(const TableRecord& r) {
  return {{"sampler", r.sampler},
          {"map", r.map},
          {"size", json_of(r.extent)},
          {"ns_per_sample", number(r.ns_per_sample)},
          {"bytes_per_texel", number(r.bytes_per_texel)},
          {"worst_texel_error", number(r.worst_texel_error)},
          {"times_baseline", number(r.times_baseline)},
          {"share_of_limit", number(r.share_of_limit)},
          {"wall_per_cpu", number(r.wall_per_cpu)}};
}

Json json_of(const DirectionRecord& r) {
  return {{"sampler", r.sampler},
          {"map", r.map},
          {"size", json_of(r.extent)},
          {"density", r.density},
          {"order", std::string(describe(r.order).name)},
          {"ns_per_sample", number(r.ns_per_sample)},
          {"times_baseline", number(r.times_baseline)},
          {"share_of_limit", number(r.share_of_limit)},
          {"wall_per_cpu", number(r.wall_per_cpu)}};
}

Json json_of(const GrowthFit& fit) {
  return {{"sampler", fit.sampler},
          {"model", fit.model},
          {"exponent", number(fit.exponent)},
          {"exponent_error", number(fit.exponent_error)},
          {"steps", list_of(fit.steps)},
          {"leaves_l2", json_of(fit.leaves_l2)},
          {"leaves_l3", json_of(fit.leaves_l3)},
          {"segmented", json_of(fit.segmented)},
          {"build_exponent", json_of(fit.build_exponent)}};
}

Json json_of(const StepTime& step) {
  return {{"size", json_of(step.extent)}, {"ns", number(step.ns)}};
}

Json json_of(const MapRecord& r) {
  Json drawn = Json::array();
  for (const SquarePoint& p : r.drawn) drawn.push_back(Json::array({number(p.s), number(p.t)}));
  return {{"name", r.map.name},
          {"source", r.source},
          {"size", json_of(r.map.radiance.extent())},
          {"mapping", describe(r.own_mapping)},
          {"own_size", json_of(r.own_texels)},
          {"mean_luminance", number(r.mean_luminance)},
          {"peak_ratio", number(r.peak_ratio)},
          {"effective_fraction", number(r.effective_fraction)},
          {"notes", r.map.notes},
          {"drawn", drawn}};
}

Json json_of(const RenderRecord& r) {
  return {{"map", r.map},
          {"receiver", r.receiver},
          {"material", r.material},
          {"estimator", r.estimator},
          {"samples", r.samples},
          {"size", json_of(r.picture.extent())},
          {"reference_samples", r.reference_samples},
          {"rmse", number(r.rmse)},
          {"seconds", number(r.seconds)},
          {"point_seconds", number(r.point_seconds)}};
}

Json renders_json(const std::vector<RenderRecord>& renders) {
  Json list = list_of(renders);
  const std::vector<std::string> stems = render_stems(renders);
  for (std::size_t i = 0; i < stems.size(); ++i) {
    list[i]["picture"] = stems[i] + ".exr";
    list[i]["error"] = stems[i] + "-error.exr";
  }
  for (const RenderScene& scene : render_scenes(renders)) {
    for (const std::size_t i : scene.members) list[i]["reference"] = scene.stem + "-reference.exr";
  }
  return list;
}

Json json_of(const CalibrationRecord& r) {
  return {{"test", full_name(r.test)},
          {"is_bound", r.is_bound},
          {"replicates", r.replicates},
          {"ks_distance", number(r.ks_distance)},
          {"log10_p_ks", number(r.log10_p_ks)},
          {"log10_p_anderson", number(r.log10_p_anderson)},
          {"below_one_percent", r.below_one_percent},
          {"quantiles", r.quantiles}};
}

Json json_of(const FamilyRecord& r) {
  return {{"procedure", r.procedure},
          {"family_alpha", number(r.family_alpha)},
          {"runs", r.runs},
          {"rejected", r.rejected},
          {"is_bound", r.is_bound}};
}

Json json_of(const PowerRecord& r) {
  return {{"test", full_name(r.test)},        {"effect", number(r.effect)},
          {"level", number(r.level)},         {"samples", r.samples},
          {"replicates", r.replicates},       {"rejected", r.rejected},
          {"predicted", number(r.predicted)}, {"is_bound", r.is_bound}};
}

Json json_of(const KillRecord& r) {
  Json kills = Json::object();
  for (const auto& [test, samples] : r.kills) kills[full_name(test)] = samples;
  return {{"mutant", r.mutant},
          {"oracle", to_string(r.oracle)},
          {"looks_like", r.looks_like},
          {"expected_diagnosis", r.expected_diagnosis},
          {"kills", kills},
          {"sequential", r.sequential ? Json(*r.sequential) : Json(nullptr)}};
}

Json json_of(const NamingRecord& r) {
  return {{"mutant", r.mutant}, {"expected", r.expected},
          {"runs", r.runs},     {"rejected", r.rejected},
          {"right", r.right},   {"unknown", r.unknown},
          {"wrong", r.wrong},   {"wrong_names", r.wrong_names}};
}

Json self_test_json(const std::optional<SelfTestResult>& self_test) {
  if (!self_test) return nullptr;
  return {{"calibration", list_of(self_test->calibration.tests)},
          {"families", list_of(self_test->calibration.families)},
          {"power", list_of(self_test->power)},
          {"mutants", list_of(self_test->mutants)},
          {"naming", list_of(self_test->naming)},
          {"origin", self_test->origin},
          {"naming_origin", self_test->naming_origin}};
}

std::string text_of(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string gate_json(const GateResult& gate, GateVerdict verdict, const RunDescription& run) {
  Json document = {{"format_version", kGateFormatVersion},
                   {"version", run.version},
                   {"commit", commit_of(run)},
                   {"command", run.command},
                   {"maps", parsed(run.maps)}};
  document.update(json_of(gate, verdict));
  return text_of(document);
}

std::string rejection_json(const GateResult& gate, const Rejection& rejection,
                           const RunDescription& run) {
  Json document = {{"format_version", kGateFormatVersion},
                   {"version", run.version},
                   {"commit", commit_of(run)},
                   {"command", run.command}};
  document.update(json_of(gate, rejection));
  return text_of(document);
}

std::string study_json(const StudyResult& study, const RunDescription& run) {
  const GateVerdict verdict = {deciding_tally(study.gate).outcome(), false};
  return text_of(
      {{"format_version", kStudyFormatVersion},
       {"version", study.version},
       {"commit", commit_of(run)},
       {"command", run.command},
       {"machine", study.machine},
       {"seed", study.seed},
       {"maps", list_of(study.maps)},
       {"gate", json_of(study.gate, verdict)},
       {"self_test", self_test_json(study.self_test)},
       {"published_forms", list_of(study.published_forms)},
       {"frames", frames_json(study.frames)},
       {"points", points_json(study.points)},
       {"level_costs", level_costs_json(study.level_costs)},
       {"stability", stability_parts_json(study.stability)},
       {"published_pictures", list_of(study.published_pictures)},
       {"split_sum", list_of(study.split_sum)},
       {"convergence", list_of(study.convergence)},
       {"accuracy", accuracy_json(study.accuracy)},
       {"recommendations", recommendations_json(study.recommendations)},
       {"refused_recommendations", refused_recommendations_json(study.refused_recommendations)},
       {"recommendation_survey", recommendation_survey_json(study.recommendation_survey)},
       {"method_regimes", method_regimes_json(study.method_regimes)},
       {"throughput", list_of(study.throughput)},
       {"throughput_origin", study.throughput_origin},
       {"directions_origin", study.directions_origin},
       {"caches", {{"l2", number(study.caches.l2)}, {"l3", number(study.caches.l3)}}},
       {"growth", list_of(study.growth)},
       {"tables", list_of(study.tables)},
       {"directions", list_of(study.directions)},
       {"renders", renders_json(study.renders)}});
}

}  // namespace lightproof
