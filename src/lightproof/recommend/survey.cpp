#include "lightproof/recommend/survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "lightproof/core/error.h"
#include "lightproof/results/accuracy_reading.h"

namespace lightproof {
namespace {

constexpr double kKeptError = 1.1;
constexpr double kKeptTime = 1.5;

/// Rounds in which a choice is measured, samples at one point in each, and estimates at most.
constexpr int kRounds = 12;
constexpr std::uint64_t kSamplesOfARound = 4096;
constexpr std::uint64_t kMostEstimatesOfARound = 64;

constexpr std::array kMaterials = {"lambert",    "phong:5", "phong:20", "phong:50", "phong:200",
                                   "phong:1000", "ggx:0.1", "ggx:0.3",  "ggx:0.5",  "ggx:0.8"};

/// Time of a shading point on a line of the chart, with its part of the set-up, by so many samples.
double seconds_at(const AccuracyLine& line, std::uint64_t samples, double shading_points) {
  MethodCost cost;
  for (const AccuracyPoint& point : line.points) {
    cost.samples.push_back(point.samples);
    cost.seconds.push_back(point.seconds);
  }
  return cost.seconds_of(samples) + line.set_up_seconds / shading_points;
}

const AccuracyLine& line_named(const AccuracyChart& chart, std::string_view estimator) {
  const auto found = std::ranges::find(chart.lines, estimator, &AccuracyLine::estimator);
  if (found == chart.lines.end()) {
    throw std::logic_error("the chart has no line of " + std::string(estimator));
  }
  return *found;
}

/// Measures the error of a choice anew: what the recommendation measured was looked at before it
/// was chosen.
void measure(RecommendedMethod& choice, const LitReceiver& lit, std::uint64_t seed) {
  const AccuracyOptions how = {
      .quality = {"", choice.samples, kRounds, 1},
      .seed = seed,
      .select = [&](const EstimatorInfo& info) { return info.name == choice.estimator; },
      .samples = [&](const EstimatorInfo&) { return std::vector{choice.samples}; },
      .samples_of_a_round = kSamplesOfARound,
      .most_estimates_of_a_round = kMostEstimatesOfARound};
  const AccuracyPoint point = measure_accuracy(lit, how).lines.front().points.front();
  choice.measured_error = point.rmse;
  choice.measured_error_error = point.rmse_error;
}

void find_best(SurveyCase& one, const AccuracyChart& chart, double shading_points) {
  one.best_seconds = std::numeric_limits<double>::infinity();
  for (const AccuracyLine& line : chart.lines) {
    const auto place = at_error(line, one.error);
    if (!place) continue;
    const double seconds = place->seconds + line.set_up_seconds / shading_points;
    if (seconds >= one.best_seconds) continue;
    one.best = line.estimator;
    one.best_seconds = seconds;
  }
}

}  // namespace

bool SurveyCase::error_is_kept() const {
  return choice ? choice->measured_error <= kKeptError * error : best.empty();
}

bool SurveyCase::time_is_kept() const {
  if (best.empty()) return true;
  return choice && choice_seconds <= kKeptTime * best_seconds;
}

std::span<const char* const> survey_materials() { return kMaterials; }

std::vector<SurveyCase> survey(const EnvironmentMap& map, const NamedMaterial& material,
                               const SurveyOptions& options, const MethodCosts& costs) {
  const LitReceiver lit(map, *options.receiver, material, options.quality.shading_points);
  const AccuracyChart chart =
      measure_accuracy(lit, {.quality = options.quality, .seed = options.seed});
  std::vector<SurveyCase> cases;
  for (const double error : options.errors) {
    RecommendOptions asked = {
        options.receiver, material, {.error = error}, options.verify, options.seed + 1};
    const auto points = static_cast<double>(asked.demand.shading_points);
    SurveyCase one{map.name, material.name, error, {}, 0.0, {}, 0.0};
    find_best(one, chart, points);
    // The best that takes longer than the budget is none.
    if (one.best_seconds > asked.demand.budget_seconds) one.best.clear();
    try {
      one.choice = recommend(map, asked, costs).choice;
    } catch (const InputError&) {
      one.choice.reset();  // no method reaches the error, it says
    }
    if (one.choice) {
      measure(*one.choice, lit, options.seed + 2);
      one.choice_seconds =
          seconds_at(line_named(chart, one.choice->estimator), one.choice->samples, points);
    }
    cases.push_back(std::move(one));
  }
  return cases;
}

}  // namespace lightproof
