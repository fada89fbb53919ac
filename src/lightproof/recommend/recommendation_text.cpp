#include "lightproof/recommend/recommendation_text.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "lightproof/estimators/registry.h"
#include "lightproof/recommend/lobe_share.h"
#include "lightproof/results/percent.h"

namespace lightproof {
namespace {

/// A prediction is off if it is so many standard errors and so much of the asked error away.
constexpr double kOffErrors = 3.0;
constexpr double kOffShare = 0.1;

/// One of two widths that is so many times the other one is no longer alike.
constexpr double kAlike = 4.0;

/// What directions are drawn from.
enum class DrawnFrom { map, lobe, both, neither };

DrawnFrom drawn_from(const EstimatorInfo& info) {
  if (!info.at_independent_points.empty()) {
    return drawn_from(estimator_by_name(info.at_independent_points));
  }
  switch (info.family) {
    case EstimatorFamily::environment:
    case EstimatorFamily::lights:
      return DrawnFrom::map;
    case EstimatorFamily::lobes:
      return DrawnFrom::lobe;
    case EstimatorFamily::product:
    case EstimatorFamily::mis:
    case EstimatorFamily::ris:
      return DrawnFrom::both;
    default:
      return DrawnFrom::neither;
  }
}

std::string_view to_string(DrawnFrom source) {
  switch (source) {
    case DrawnFrom::map:
      return "sampling the map";
    case DrawnFrom::lobe:
      return "sampling the lobe";
    case DrawnFrom::both:
      return "sampling both";
    case DrawnFrom::neither:
      return "sampling neither";
  }
  return "";
}

/// What the widths of light and lobe alone would choose.
DrawnFrom expected_from(double light, double lobe) {
  if (light * kAlike < lobe) return DrawnFrom::map;
  if (lobe * kAlike < light) return DrawnFrom::lobe;
  return DrawnFrom::both;
}

/// ", so sampling the map wins".
std::string consequence_of(const RecommendedMethod& choice, double light, double lobe) {
  if (!choice.has_samples) {
    return fmt::format(
        ", and what is made beforehand has an error of {}",
        plain_percent(std::isfinite(choice.measured_error) ? choice.measured_error
                                                           : choice.predicted_error));
  }
  const DrawnFrom source = drawn_from(estimator_by_name(choice.estimator));
  const bool is_expected = source == expected_from(light, lobe);
  return fmt::format(", {} {} wins", is_expected ? "so" : "yet", to_string(source));
}

}  // namespace

std::string reason_of(const Recommendation& recommendation, const MapSummary& summary,
                      const Material& material) {
  const double light = summary.effective_fraction;
  const double lobe = lobe_share(material);
  std::string reason = fmt::format("the light fills {} of the sphere and the material's lobe {}{}",
                                   plain_percent(light), plain_percent(lobe),
                                   consequence_of(recommendation.choice, light, lobe));
  if (const auto& rival = recommendation.runner_up) {
    const std::uint64_t points = recommendation.question.shading_points;
    const double times = rival->known_time().with_set_up(points) /
                         recommendation.choice.known_time().with_set_up(points);
    reason +=
        fmt::format("; {}, the runner-up, takes {:.2g} times as long", rival->estimator, times);
  }
  return reason + ".";
}

std::string warning_of(const Recommendation& recommendation, const MethodDemand& demand) {
  const RecommendedMethod& method = recommendation.choice;
  if (!std::isfinite(method.measured_error)) {
    if (!demand.is_occluded) return {};
    return fmt::format(
        "the error is that of a receiver with nothing in the way of light: what is in the way on "
        "'{}' is not predicted, but measured without --no-verify",
        recommendation.question.receiver);
  }
  if (!std::isfinite(method.predicted_error)) return {};
  const double off = method.measured_error - method.predicted_error;
  const bool is_off = std::abs(off) > kOffErrors * method.measured_error_error &&
                      std::abs(off) > kOffShare * recommendation.question.error;
  if (!is_off || (method.is_upper_bound && off < 0.0)) return {};
  return fmt::format(
      "the prediction was off: {}{} was predicted, {} measured{}",
      method.is_upper_bound ? "at most " : "", plain_percent(method.predicted_error),
      plain_percent(method.measured_error),
      demand.is_occluded ? ", as it knows nothing of what is in the way of light" : "");
}

std::string refusal_of(const RefusedRecommendation& refused) {
  const RecommendationQuestion& question = refused.question;
  std::string text =
      fmt::format("{}: no method reaches an error of {} on the receiver '{}' in '{}'", question.map,
                  plain_percent(question.error), question.receiver, question.material);
  for (const UnreachedFamily& family : refused.unreached) {
    text += fmt::format("; {}: {}", to_string(family.family), family.reason);
  }
  return text;
}

}  // namespace lightproof
