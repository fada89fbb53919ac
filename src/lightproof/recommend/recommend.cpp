#include "lightproof/recommend/recommend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lightproof/accuracy/measurement.h"
#include "lightproof/core/error.h"
#include "lightproof/core/measure.h"
#include "lightproof/estimators/reduced_table.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/recommend/map_summary.h"

namespace lightproof {
namespace {

/// Candidates that are run at the most, and how much longer than the best one they may be expected
/// to take.
constexpr std::size_t kMostRun = 10;
constexpr double kWorthATry = 1.6;

/// Candidates that are verified at the most.
constexpr std::size_t kMostVerified = 3;

/// Steps between numbers of samples that are run to find one.
constexpr double kSearchStep = 2.0;

/// An error so much above the one that is asked for is missed; so often is it corrected.
constexpr double kMissed = 1.02;
constexpr int kMostAttempts = 4;

/// Samples at one point in a round, and estimates at most.
constexpr std::uint64_t kSamplesOfARound = 4096;
constexpr std::uint64_t kMostEstimatesOfARound = 64;

/// Rounds of a search, and of the measurement of what was found.
constexpr int kSearchRounds = 6;
constexpr int kFinalRounds = 12;

/// A prediction is off if it is so many standard errors and so much of the asked error away.
constexpr double kOffErrors = 3.0;
constexpr double kOffShare = 0.1;

/// The numbers of samples at which a candidate is run.
std::vector<std::uint64_t> search_samples(const Candidate& candidate, const MethodDemand& demand) {
  if (!is_uncertain(candidate.error, demand)) return {candidate.samples};
  const std::uint64_t most_samples = kMostDirections / candidate.info->candidates;
  const double most =
      std::min(static_cast<double>(most_samples),
               static_cast<double>(candidate.samples) * (demand.is_occluded ? 4.0 : 1.0));
  std::vector<std::uint64_t> samples;
  for (double n = static_cast<double>(fewest_samples(candidate, demand)); n < most * kSearchStep;
       n *= kSearchStep) {
    const std::uint64_t next = in_steps(*candidate.info, n);
    if (samples.empty() || next > samples.back()) samples.push_back(next);
  }
  return samples;
}

/// Those that may turn out the cheapest.
std::vector<Candidate> worth_a_try(const std::vector<Candidate>& all, const MethodDemand& demand) {
  std::vector<Candidate> chosen = all;
  const auto hoped = [&](const Candidate& candidate) {
    return candidate.seconds(demand, fewest_samples(candidate, demand));
  };
  std::ranges::stable_sort(chosen, {}, hoped);
  // What certainly does it, at the least.
  double sure = std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : all) {
    if (obstacle_to(demand, candidate, candidate.samples).empty()) {
      sure = std::min(sure, candidate.seconds(demand, candidate.samples));
    }
  }
  const auto is_worth = [&](const Candidate& c) { return hoped(c) <= kWorthATry * sure; };
  const auto worth = static_cast<std::size_t>(std::ranges::count_if(chosen, is_worth));
  chosen.resize(std::min(chosen.size(), std::clamp<std::size_t>(worth, 2, kMostRun)));
  return chosen;
}

/// Errors of candidates as measured, at the numbers of samples of each.
using MeasuredLines = std::map<std::string, AccuracyLine, std::less<>>;
using SamplesOf = std::map<std::string_view, std::vector<std::uint64_t>>;

MeasuredLines measure(const LitReceiver& lit, const SamplesOf& samples, int rounds,
                      std::uint64_t seed) {
  const AccuracyOptions how = {
      .quality = {"", kMostDirections, rounds, kReceiverPoints},
      .seed = seed,
      .select = [&](const EstimatorInfo& info) { return samples.contains(info.name); },
      .samples = [&](const EstimatorInfo& info) { return samples.at(info.name); },
      .samples_of_a_round = kSamplesOfARound,
      .most_estimates_of_a_round = kMostEstimatesOfARound};
  MeasuredLines lines;
  const AccuracyChart chart = measure_accuracy(lit, how);
  for (const AccuracyLine& line : chart.lines) lines.emplace(line.estimator, line);
  return lines;
}

/// The number of samples at which a measured line falls to the error, between two points by a
/// straight line on log-log paper; none if it does not.
std::optional<std::uint64_t> crossing(const EstimatorInfo& info, const AccuracyLine& line,
                                      double error) {
  const std::vector<AccuracyPoint>& points = line.points;
  // From the right: a line that dips below the error and rises again does not reach it there.
  std::size_t i = points.size();
  while (i > 0 && points[i - 1].rmse <= error) --i;
  if (i == points.size()) return std::nullopt;
  if (i == 0) return points.front().samples;
  const AccuracyPoint& above = points[i - 1];
  const AccuracyPoint& below = points[i];
  const double share = std::log(above.rmse / error) / std::log(above.rmse / below.rmse);
  const double samples =
      static_cast<double>(above.samples) *
      std::pow(static_cast<double>(below.samples) / static_cast<double>(above.samples), share);
  return in_steps(info, samples);
}

void sort_by_time(std::vector<Candidate>& candidates, const MethodDemand& demand) {
  std::ranges::stable_sort(candidates, {}, [&](const Candidate& candidate) {
    return candidate.seconds(demand, candidate.samples);
  });
}

/// Candidates at the numbers of samples at which they were seen to reach the error; the cheapest
/// first.
std::vector<Candidate> found_by_trying(const LitReceiver& lit, const RecommendOptions& options,
                                       const std::vector<Candidate>& tried) {
  SamplesOf samples;
  for (const Candidate& candidate : tried) {
    if (is_uncertain(candidate.error, options.demand)) {
      samples[candidate.info->name] = search_samples(candidate, options.demand);
    }
  }
  const MeasuredLines lines =
      samples.empty() ? MeasuredLines() : measure(lit, samples, kSearchRounds, options.seed);
  std::vector<Candidate> found;
  for (Candidate candidate : tried) {
    if (is_uncertain(candidate.error, options.demand)) {
      const auto at = crossing(*candidate.info, lines.at(std::string(candidate.info->name)),
                               options.demand.error);
      if (!at) continue;
      candidate.samples = *at;
      if (!obstacle_to(options.demand, candidate, *at).empty()) continue;
    }
    found.push_back(std::move(candidate));
  }
  sort_by_time(found, options.demand);
  return found;
}

/// A candidate and what was measured of it.
struct Verified {
  Candidate candidate;
  AccuracyPoint point;
};

/// Measures candidates at their numbers of samples. Those that miss the error get more samples, as
/// many as a slope of -1/2 asks for, and are measured again. Seeds differ from those of the search.
std::vector<Verified> verified(const LitReceiver& lit, const RecommendOptions& options,
                               std::vector<Candidate> candidates) {
  std::vector<Verified> all;
  for (int attempt = 1; !candidates.empty(); ++attempt) {
    SamplesOf samples;
    for (const Candidate& candidate : candidates) {
      samples[candidate.info->name] = {candidate.samples};
    }
    const MeasuredLines lines =
        measure(lit, samples, kFinalRounds, options.seed + static_cast<std::uint64_t>(attempt));
    std::vector<Candidate> again;
    for (Candidate& candidate : candidates) {
      const AccuracyPoint& point = lines.at(std::string(candidate.info->name)).points.front();
      const double ratio = point.rmse / options.demand.error;
      if (attempt < kMostAttempts && ratio > kMissed &&
          is_uncertain(candidate.error, options.demand)) {
        candidate.samples =
            in_steps(*candidate.info, static_cast<double>(candidate.samples) * ratio * ratio);
        again.push_back(std::move(candidate));
      } else {
        all.push_back({std::move(candidate), point});
      }
    }
    candidates = std::move(again);
  }
  std::ranges::stable_sort(all, {}, [&](const Verified& one) {
    return one.candidate.seconds(options.demand, one.candidate.samples);
  });
  return all;
}

/// The size of the table of the map that an estimator draws from.
Extent table_of(const EstimatorInfo& info, Extent map) {
  const EstimatorInfo& drawn =
      info.at_independent_points.empty() ? info : estimator_by_name(info.at_independent_points);
  const bool draws_from_map = drawn.family == EstimatorFamily::environment ||
                              drawn.family == EstimatorFamily::mis ||
                              drawn.family == EstimatorFamily::ris;
  return draws_from_map ? reduced_extent(map, drawn.table_reduction) : Extent{0, 0};
}

RecommendedMethod method_of(const Verified& verified, Extent map) {
  const Candidate& candidate = verified.candidate;
  RecommendedMethod method;
  method.estimator = candidate.info->name;
  method.samples = candidate.samples;
  method.has_samples = !candidate.info->ignores_budget;
  method.bytes = static_cast<std::size_t>(candidate.cost.bytes);
  method.table = table_of(*candidate.info, map);
  method.predicted_error = candidate.error.at(candidate.samples);
  method.is_upper_bound = candidate.error.law == ErrorLaw::at_most;
  if (verified.point.samples > 0) {
    method.measured_error = verified.point.rmse;
    method.measured_error_error = verified.point.rmse_error;
  }
  method.milliseconds = 1e3 * candidate.cost.seconds_of(candidate.samples);
  method.set_up_milliseconds = 1e3 * candidate.cost.set_up_seconds;
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

/// The part of the sphere that the material's lobe fills, 4 pi for a constant one: (∫ρ)^2 / ∫ρ^2
/// over 4 pi, of ρ = f_r (n·l)+ seen along the normal and not cut by the horizon.
double lobe_share(const Material& material) {
  if (const auto* phong = std::get_if<ModifiedPhong>(&material)) {
    const double n = phong->exponent;
    return 0.5 * (2.0 * n + 1.0) / ((n + 1.0) * (n + 1.0));
  }
  if (const auto* ggx = std::get_if<Ggx>(&material)) {
    const double a2 = ggx_alpha(ggx->roughness) * ggx_alpha(ggx->roughness);
    return 3.0 * a2 / (1.0 + a2 + a2 * a2);
  }
  return 0.375;  // of a cosine: 3 pi / 2
}

std::string percent(double share) {
  return share < 0.1 ? fmt::format("{:.2g} %", 100.0 * share)
                     : fmt::format("{:.0f} %", 100.0 * share);
}

/// One sentence.
std::string reason_of(const Recommendation& recommendation, const Candidate& choice,
                      const MapSummary& summary, const Material& material) {
  const double light = summary.effective_fraction;
  const double lobe = lobe_share(material);
  const std::string widths = fmt::format(
      "the light fills {} of the sphere and the material's lobe {}", percent(light), percent(lobe));
  std::string reason;
  if (choice.error.law == ErrorLaw::constant) {
    reason = fmt::format("its error is {} whatever the number of samples, and {}",
                         percent(choice.error.at(1)), widths);
  } else {
    reason = widths;
  }
  if (recommendation.runner_up) {
    reason += fmt::format(
        "; {}, the runner-up, takes {:.2g} times as long", recommendation.runner_up->estimator,
        recommendation.runner_up->milliseconds / recommendation.choice.milliseconds);
  }
  return reason + ".";
}

std::string warning_of(const Recommendation& recommendation, const Candidate& choice) {
  const RecommendedMethod& method = recommendation.choice;
  if (!std::isfinite(method.measured_error)) return {};
  const double off = method.measured_error - method.predicted_error;
  const bool is_off = std::abs(off) > kOffErrors * method.measured_error_error &&
                      std::abs(off) > kOffShare * recommendation.error;
  const bool is_told = choice.error.law == ErrorLaw::at_most ? off > 0.0 : true;
  if (!is_off || !is_told) return {};
  return fmt::format("the prediction was off: {} was predicted, {} measured",
                     percent(method.predicted_error), percent(method.measured_error));
}

[[noreturn]] void refuse(const EnvironmentMap& map, const RecommendOptions& options,
                         const std::vector<UnreachedFamily>& unreached) {
  std::string text =
      fmt::format("{}: no method reaches an error of {} on the receiver '{}' in '{}'", map.name,
                  percent(options.demand.error), options.receiver->name, options.material.name);
  for (const UnreachedFamily& family : unreached) {
    text += fmt::format("; {}: {}", family.family, family.reason);
  }
  throw InputError(text);
}

}  // namespace

Recommendation recommend(const EnvironmentMap& map, const RecommendOptions& options,
                         const MethodCosts& costs, const Progress& progress) {
  Recommendation recommendation;
  recommendation.map = map.name;
  recommendation.receiver = options.receiver->name;
  recommendation.material = options.material.name;
  recommendation.error = options.demand.error;
  recommendation.shading_points = options.demand.shading_points;
  const Scene scene(options.receiver->content);
  std::vector<ShadingPoint> points;
  for (const Pixel& pixel : receiver_points(*options.receiver, scene, kReceiverPoints)) {
    points.push_back(pixel.point);
  }
  if (progress) progress("prediction", 0.0);
  const MapSummary summary = summarise(map);
  const Prediction prediction = predict(summary, options.material.material, points);
  MethodDemand demand = options.demand;
  demand.is_occluded = options.receiver->occluded;
  demand.will_be_tried = options.verify;
  RecommendOptions asked = options;
  asked.demand = demand;
  const Candidates all = candidates_for(demand, prediction, costs, map.radiance.extent());
  recommendation.unreached = all.unreached;
  if (all.reaching.empty()) refuse(map, options, all.unreached);
  std::vector<Verified> best;
  if (options.verify) {
    const std::vector<Candidate> tried = worth_a_try(all.reaching, demand);
    if (progress) progress("exact light", 0.1);
    const LitReceiver lit(map, *options.receiver, options.material, kReceiverPoints,
                          filter_of(tried));
    if (progress) progress("verification", 0.5);
    std::vector<Candidate> found = found_by_trying(lit, asked, tried);
    if (found.empty()) refuse(map, options, all.unreached);
    found.resize(std::min<std::size_t>(found.size(), kMostVerified), found.front());
    best = verified(lit, asked, std::move(found));
  } else {
    for (const Candidate& candidate : all.reaching) best.push_back({candidate, {}});
  }
  recommendation.choice = method_of(best[0], map.radiance.extent());
  if (best.size() > 1) recommendation.runner_up = method_of(best[1], map.radiance.extent());
  recommendation.reason =
      reason_of(recommendation, best[0].candidate, summary, options.material.material);
  recommendation.warning = warning_of(recommendation, best[0].candidate);
  return recommendation;
}

}  // namespace lightproof
