// How good recommendations are: each held against every method, measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace lightproof {

/// The goals: in so many of the answers the error is at most so many times what was asked for, and
/// the time at most so many times that of the best method.
inline constexpr double kKeptError = 1.1;
inline constexpr double kErrorsKept = 0.95;
inline constexpr double kKeptTime = 1.5;
inline constexpr double kTimesKept = 0.90;

/// What was recommended, and what it does.
struct SurveyedChoice {
  std::string estimator;
  std::uint64_t samples = 0;
  double predicted_error = std::numeric_limits<double>::quiet_NaN();
  /// By the run on which it was chosen; not a number if it was chosen without one.
  double verified_error = std::numeric_limits<double>::quiet_NaN();
  /// By a run of other random numbers, which is what it is judged by.
  double error = 0.0;
  double seconds = 0.0;  ///< at a shading point, its part of the set-up in it, by the chart

  static auto fields(auto& choice) {
    return std::tie(choice.estimator, choice.samples, choice.predicted_error, choice.verified_error,
                    choice.error, choice.seconds);
  }
};

/// One question, its answer, and the best answer that was found by measuring all methods.
struct SurveyCase {
  std::string map;
  std::string material;
  double error = 0.0;  ///< that was asked for
  /// Empty if the answer was that no method reaches the error.
  std::optional<SurveyedChoice> choice;
  /// The method that reaches the error in the least time of all in the chart; empty if none does
  /// within the budget.
  std::string best;
  double best_seconds = 0.0;
  bool was_tuned_on = false;  ///< whether the map was looked at while predictions were built

  static auto fields(auto& one) {
    return std::tie(one.map, one.material, one.error, one.choice, one.best, one.best_seconds,
                    one.was_tuned_on);
  }
  /// Whether it was refused, and no method was found that does it.
  bool is_rightly_refused() const { return !choice && best.empty(); }
  /// Whether the measured error is at most kKeptError times what was asked for.
  bool error_is_kept() const;
  /// Whether the time is at most kKeptTime times that of the best, or there is no best one.
  bool time_is_kept() const;
  /// How many times worse than it may be, 0 if all is kept; a wrong refusal is worst.
  double badness() const;
};

/// How often the goals are kept. What was rightly refused is counted apart; what was wrongly
/// refused keeps neither.
struct SurveyShares {
  std::size_t answered = 0;  ///< cases but for those that were rightly refused
  std::size_t rightly_refused = 0;
  std::size_t wrongly_refused = 0;
  double errors_kept = 0.0;  ///< a share of `answered`
  double times_kept = 0.0;

  bool reaches_goals() const { return errors_kept >= kErrorsKept && times_kept >= kTimesKept; }
};

/// All cases of one receiver.
struct RecommendationSurvey {
  std::string origin;  ///< when, on which machine, of which commit
  std::string receiver;
  std::string quality;  ///< of the charts
  std::vector<SurveyCase> cases;

  static auto fields(auto& survey) {
    return std::tie(survey.origin, survey.receiver, survey.quality, survey.cases);
  }
};

/// The shares of some cases in which error and time were kept.
SurveyShares shares_of(const std::vector<SurveyCase>& cases);

/// The cases on maps that were looked at while building, or those on the others.
std::vector<SurveyCase> cases_of(const RecommendationSurvey& survey, bool was_tuned_on);

/// The worst of those that are not as they should be, at most so many, the worst first.
std::vector<SurveyCase> worst_of(std::vector<SurveyCase> cases, std::size_t count);

}  // namespace lightproof
