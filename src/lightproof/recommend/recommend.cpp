#include "lightproof/recommend/recommend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "lightproof/estimators/reduced_table.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/image/lat_long_texels.h"
#include "lightproof/recommend/map_summary.h"
#include "lightproof/recommend/recommendation_text.h"
#include "lightproof/recommend/verification.h"

namespace lightproof {
namespace {

/// Candidates that are run together at the most, and how much longer than what certainly does it
/// one of them may be expected to take.
constexpr std::size_t kMostRun = 14;
constexpr double kWorthATry = 1.6;

/// A choice and a rival, as predicted or as verified, and what is not reached.
struct Answer {
  std::vector<RecommendedMethod> methods;
  std::vector<UnreachedFamily> unreached;
};

/// The places of those that certainly reach the error in the least time: a choice and a rival.
std::vector<std::size_t> surest(const std::vector<Candidate>& candidates,
                                const MethodDemand& demand) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!is_uncertain(candidates[i], demand)) indices.push_back(i);
  }
  std::ranges::stable_sort(indices, {}, [&](std::size_t i) {
    return candidates[i].seconds(demand, candidates[i].samples);
  });
  const auto count = static_cast<std::ptrdiff_t>(std::min<std::size_t>(indices.size(), 2));
  return {indices.begin(), indices.begin() + count};
}

/// Takes the candidates that are to be run next: of those that come first the ones that may take
/// less time than what certainly does it, or a little more; and the surest ones.
std::vector<Candidate> take_some(std::vector<Candidate>& left, const MethodDemand& demand) {
  const std::vector<std::size_t> sure = surest(left, demand);
  const double sure_seconds = sure.empty()
                                  ? std::numeric_limits<double>::infinity()
                                  : left[sure.front()].seconds(demand, left[sure.front()].samples);
  std::vector<Candidate> taken;
  std::vector<Candidate> rest;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const bool is_sure = std::ranges::find(sure, i) != sure.end();
    const bool is_worth = hoped_seconds(left[i], demand) <= kWorthATry * sure_seconds;
    const bool is_taken = is_sure || (is_worth && taken.size() < kMostRun);
    (is_taken ? taken : rest).push_back(std::move(left[i]));
  }
  left = std::move(rest);
  return taken;
}

/// The size of the table of the map that an estimator draws from.
Extent table_of(const EstimatorInfo& info, Extent map) {
  const EstimatorInfo& drawn =
      info.at_independent_points.empty() ? info : estimator_by_name(info.at_independent_points);
  const bool draws_from_map =
      drawn.family == EstimatorFamily::environment || drawn.family == EstimatorFamily::product ||
      drawn.family == EstimatorFamily::mis || drawn.family == EstimatorFamily::ris;
  return draws_from_map ? reduced_extent(map, drawn.table_reduction) : Extent{0, 0};
}

RecommendedMethod method_of(const Candidate& candidate, Extent map) {
  RecommendedMethod method;
  method.estimator = candidate.info->name;
  method.samples = candidate.samples;
  method.has_samples = !candidate.info->ignores_budget;
  method.bytes = static_cast<std::size_t>(candidate.cost.bytes);
  method.table = table_of(*candidate.info, map);
  if (const auto& error = candidate.error) {
    method.predicted_error = error->at(candidate.samples);
    method.is_upper_bound = error->model == ErrorModel::at_most ||
                            (error->model == ErrorModel::constant && error->variance > 0.0);
  }
  method.predicted_time = {1e3 * candidate.cost.seconds_of(candidate.samples),
                           1e3 * candidate.cost.set_up_seconds};
  return method;
}

RecommendedMethod method_of(const Verified& verified, Extent map) {
  RecommendedMethod method = method_of(verified.candidate, map);
  method.bytes = verified.line.bytes;
  method.measured_error = verified.point().rmse;
  method.measured_error_error = verified.point().rmse_error;
  method.measured_time = {1e3 * verified.point().seconds,
                          1e3 * verified.line.set_up_processor_seconds};
  return method;
}

/// Those that are tried, and what draws the same at independent points: of these variances are
/// asked for.
EstimatorFilter filter_of(std::span<const Candidate> tried) {
  std::set<std::string_view> names;
  for (const Candidate& candidate : tried) {
    names.insert(candidate.info->name);
    names.insert(candidate.info->at_independent_points);
  }
  return [names](const EstimatorInfo& info) { return names.contains(info.name); };
}

/// The answer by predictions alone.
Answer predicted_answer(Candidates all, const MethodDemand& demand, Extent map) {
  Answer answer;
  std::vector<EstimatorFamily> reached;
  for (const Candidate& candidate : all.possible) {
    answer.methods.push_back(method_of(candidate, map));
    reached.push_back(candidate.info->family);
  }
  std::ranges::stable_sort(answer.methods, {}, [&](const RecommendedMethod& method) {
    return method.predicted_time.with_set_up(demand.shading_points);
  });
  answer.unreached = all.obstacles.list(reached);
  return answer;
}

/// The search for an answer that measured runs bear out.
class Trial {
 public:
  Trial(const EnvironmentMap& map, const RecommendOptions& options, const MethodDemand& demand,
        Candidates all)
      : map_(&map),
        options_(&options),
        demand_(&demand),
        left_(std::move(all.possible)),
        obstacles_(std::move(all.obstacles)) {}

  Answer answer(const Progress& progress) {
    while (verified_.empty() && !left_.empty()) run(take_some(left_, *demand_), progress);
    Answer answer;
    std::vector<EstimatorFamily> reached;
    for (const Candidate& candidate : left_) reached.push_back(candidate.info->family);
    for (const Verified& one : verified_) {
      answer.methods.push_back(method_of(one, map_->radiance.extent()));
      reached.push_back(one.candidate.info->family);
    }
    answer.unreached = obstacles_.list(reached);
    return answer;
  }

 private:
  void run(const std::vector<Candidate>& tried, const Progress& progress) {
    if (progress) progress("exact light", 0.1);
    const LitReceiver lit(*map_, *options_->receiver, options_->material, kReceiverPoints,
                          filter_of(tried));
    if (progress) progress("verification", 0.5);
    const RunEstimators run = run_on(lit, options_->seed);
    Search search = search_samples(run, *demand_, tried);
    Verification verification = verify(run, *demand_, search.found);
    verified_ = std::move(verification.reaching);
    for (auto* failed : {&search.failed, &verification.failed}) {
      for (auto& [candidate, obstacle] : *failed) {
        obstacles_.add(candidate.info->family, std::move(obstacle));
      }
    }
    for (auto* too_slow : {&verification.too_slow, &search.too_slow}) {
      left_.insert(left_.end(), std::make_move_iterator(too_slow->begin()),
                   std::make_move_iterator(too_slow->end()));
    }
  }

  const EnvironmentMap* map_;
  const RecommendOptions* options_;
  const MethodDemand* demand_;
  std::vector<Candidate> left_;  ///< not run, or not to the end, as others take less time
  FamilyObstacles obstacles_;
  std::vector<Verified> verified_;
};

std::vector<ShadingPoint> points_of(const ReceiverInfo& receiver) {
  const Scene scene(receiver.content);
  std::vector<ShadingPoint> points;
  for (const Pixel& pixel : receiver_points(receiver, scene, kReceiverPoints)) {
    points.push_back(pixel.point);
  }
  return points;
}

void require_light(const EnvironmentMap& map, const MapSummary& summary) {
  if (summary.has_light()) return;
  throw InputError(fmt::format(
      "{}: the map is black: there is no light of which an error could be a share", map.name));
}

}  // namespace

NoMethodReaches::NoMethodReaches(RefusedRecommendation refused)
    : InputError(refusal_of(refused)), refused_(std::move(refused)) {}

Recommendation recommend(const EnvironmentMap& map, const RecommendOptions& options,
                         const MethodCosts& costs, const Progress& progress) {
  require_lat_long(map, "a recommendation");
  if (progress) progress("prediction", 0.0);
  const MapSummary summary = summarise(map);
  require_light(map, summary);
  const Prediction prediction =
      predict(summary, options.material.material, points_of(*options.receiver));
  if (!(prediction.mean > 0.0)) {
    throw InputError(fmt::format("{}: no light of this map reaches the receiver '{}'", map.name,
                                 options.receiver->name));
  }
  MethodDemand demand = options.demand;
  demand.is_occluded = options.receiver->occluded;
  demand.will_be_tried = options.verify;
  Candidates all = candidates_for(demand, prediction, costs, map.radiance.extent());
  Recommendation made;
  made.question = {map.name, std::string(options.receiver->name), options.material.name,
                   demand.error, demand.shading_points};
  if (!options.verify) made.unpredicted = all.unpredicted;
  Answer answer = options.verify ? Trial(map, options, demand, std::move(all)).answer(progress)
                                 : predicted_answer(std::move(all), demand, map.radiance.extent());
  if (answer.methods.empty()) {
    throw NoMethodReaches({std::move(made.question), std::move(answer.unreached)});
  }
  made.choice = answer.methods[0];
  if (answer.methods.size() > 1) made.runner_up = answer.methods[1];
  made.unreached = std::move(answer.unreached);
  made.reason = reason_of(made, summary, options.material.material);
  made.warning = warning_of(made, demand);
  return made;
}

}  // namespace lightproof
