#include "lightproof/report/survey_html.h"

#include <fmt/format.h>

#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"

namespace lightproof {
namespace {

constexpr std::size_t kWorst = 5;

/// "96 % (goal: 95 %)".
Cell goal_cell(double share, double goal) {
  return {fmt::format("{} (goal: {})", percent(share), percent(goal)), "number", ""};
}

std::string shares_html(const RecommendationSurvey& survey) {
  Table table(
      "How good recommendations are",
      {"Maps", "Answers", fmt::format("Error within {} \u00d7", kKeptError),
       fmt::format("Time within {} \u00d7", kKeptTime), "Wrongly refused", "Rightly refused"});
  for (const bool was_tuned_on : {true, false}) {
    const SurveyShares shares = shares_of(cases_of(survey, was_tuned_on));
    if (shares.answered + shares.rightly_refused == 0) continue;
    table.add({text_cell(was_tuned_on ? "looked at while building" : "others"),
               {with_thousands(shares.answered), "number", ""},
               goal_cell(shares.errors_kept, kErrorsKept),
               goal_cell(shares.times_kept, kTimesKept),
               {with_thousands(shares.wrongly_refused), "number", ""},
               {with_thousands(shares.rightly_refused), "number", ""}});
  }
  return table.html();
}

std::string choice_text(const std::optional<SurveyedChoice>& choice) {
  if (!choice) return "refused";
  return fmt::format("{}, {}", choice->estimator, counted(choice->samples, "sample"));
}

std::string worst_html(const RecommendationSurvey& survey) {
  const std::vector<SurveyCase> worst = worst_of(survey.cases, kWorst);
  if (worst.empty()) return "";
  Table table("The worst cases", {"Map", "Material", "Asked error", "Take", "Its error", "Its time",
                                  "Fastest as measured", "Its time"});
  for (const SurveyCase& one : worst) {
    const auto& choice = one.choice;
    table.add({text_cell(one.map),
               text_cell(one.material),
               {percent(one.error), "number", ""},
               text_cell(choice_text(choice)),
               {choice ? percent(choice->error) : "\u2013", "number", ""},
               {choice ? seconds_text(choice->seconds) : "\u2013", "number", ""},
               text_cell(one.best.empty() ? "none" : one.best),
               {one.best.empty() ? "\u2013" : seconds_text(one.best_seconds), "number", ""}});
  }
  return collapsible("The worst cases", table.html());
}

}  // namespace

std::string survey_html(const std::optional<RecommendationSurvey>& survey) {
  if (!survey || survey->cases.empty()) return "";
  const std::string note = fmt::format(
      "How good such answers are: each was held against every method, measured on the receiver "
      "{}. Its error, by random numbers of its own, may be {} times what was asked for, its time "
      "{} times that of the fastest method found. Measured {}.",
      survey->receiver, kKeptError, kKeptTime, survey->origin);
  return shares_html(*survey) + paragraph(note, "note") + worst_html(*survey);
}

}  // namespace lightproof
