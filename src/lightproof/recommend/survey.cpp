#include "lightproof/recommend/survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "lightproof/core/kept_file.h"
#include "lightproof/core/serialise.h"
#include "lightproof/recommend/verification.h"
#include "lightproof/results/accuracy_reading.h"

namespace lightproof {
namespace {

constexpr std::array kMaterials = {"lambert",    "phong:5", "phong:20", "phong:50", "phong:200",
                                   "phong:1000", "ggx:0.1", "ggx:0.3",  "ggx:0.5",  "ggx:0.8"};

/// Its form: what is kept in another one is not read.
KeptFile place_in(const std::filesystem::path& folder) {
  return {folder, "recommendations", "survey of recommendations, form 1"};
}

/// Time of a shading point on a line of the chart, with its part of the set-up, by so many samples.
double seconds_at(const AccuracyLine& line, std::uint64_t samples, double shading_points) {
  MethodCost cost;
  for (const AccuracyPoint& point : line.points) {
    cost.samples.push_back(point.samples);
    cost.seconds.push_back(point.seconds);
  }
  return cost.seconds_of(samples) + line.set_up_processor_seconds / shading_points;
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
double measured_error(const RecommendedMethod& choice, const LitReceiver& lit, std::uint64_t seed) {
  const SamplesOf samples = {{choice.estimator, {choice.samples}}};
  const MeasuredLines lines = run_on(lit, seed)(samples, {kFinalRounds, "survey"});
  return lines.at(choice.estimator).points.front().rmse;
}

void find_best(SurveyCase& one, const AccuracyChart& chart, double shading_points) {
  one.best_seconds = std::numeric_limits<double>::infinity();
  for (const AccuracyLine& line : chart.lines) {
    const auto point = at_error(line, one.error);
    if (!point) continue;
    const double seconds = point->seconds + line.set_up_processor_seconds / shading_points;
    if (seconds >= one.best_seconds) continue;
    one.best = line.estimator;
    one.best_seconds = seconds;
  }
}

}  // namespace

std::span<const char* const> survey_materials() { return kMaterials; }

std::vector<SurveyCase> survey(const EnvironmentMap& map, const NamedMaterial& material,
                               const SurveyOptions& options, const MethodCosts& costs) {
  const LitReceiver lit(map, *options.receiver, material, options.quality.shading_points);
  const AccuracyChart chart =
      measure_accuracy(lit, {.quality = options.quality, .seed = options.seed});
  std::vector<SurveyCase> cases;
  for (const double error : options.errors) {
    const RecommendOptions asked = {
        options.receiver, material, {.error = error}, options.verify, options.seed};
    const auto points = static_cast<double>(asked.demand.shading_points);
    SurveyCase one{map.name, material.name, error, {}, {}, 0.0};
    find_best(one, chart, points);
    // The best that takes longer than the budget is none.
    if (one.best_seconds > asked.demand.budget_seconds) one.best.clear();
    try {
      const RecommendedMethod choice = recommend(map, asked, costs).choice;
      one.choice =
          SurveyedChoice{choice.estimator,
                         choice.samples,
                         choice.predicted_error,
                         choice.measured_error,
                         measured_error(choice, lit, options.seed),
                         seconds_at(line_named(chart, choice.estimator), choice.samples, points)};
    } catch (const NoMethodReaches&) {
      one.choice.reset();
    }
    cases.push_back(std::move(one));
  }
  return cases;
}

bool keep_survey(const std::filesystem::path& folder, const RecommendationSurvey& survey) {
  ValueWriter writer;
  writer.add(survey);
  return keep(place_in(folder), writer.take());
}

std::optional<RecommendationSurvey> kept_survey(const std::filesystem::path& folder) {
  const std::optional<std::string> bytes = read_kept(place_in(folder));
  if (!bytes) return std::nullopt;
  try {
    ValueReader reader(*bytes);
    auto survey = reader.value<RecommendationSurvey>();
    return reader.is_at_end() ? std::optional(std::move(survey)) : std::nullopt;
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
}

}  // namespace lightproof
