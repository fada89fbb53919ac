#include "lightproof/results/recommendation_survey.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

namespace lightproof {

bool SurveyCase::error_is_kept() const { return choice && choice->error <= kKeptError * error; }

bool SurveyCase::time_is_kept() const {
  return choice && (best.empty() || choice->seconds <= kKeptTime * best_seconds);
}

double SurveyCase::badness() const {
  if (is_rightly_refused()) return 0.0;
  if (!choice) return std::numeric_limits<double>::infinity();
  double worst = 0.0;
  if (!error_is_kept()) worst = choice->error / error / kKeptError;
  if (!time_is_kept()) worst = std::max(worst, choice->seconds / best_seconds / kKeptTime);
  return worst;
}

SurveyShares shares_of(const std::vector<SurveyCase>& cases) {
  SurveyShares shares;
  double errors = 0.0;
  double times = 0.0;
  for (const SurveyCase& one : cases) {
    if (one.is_rightly_refused()) {
      ++shares.rightly_refused;
      continue;
    }
    ++shares.answered;
    if (!one.choice) ++shares.wrongly_refused;
    errors += one.error_is_kept() ? 1.0 : 0.0;
    times += one.time_is_kept() ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(shares.answered);
  shares.errors_kept = shares.answered > 0 ? errors / count : 1.0;
  shares.times_kept = shares.answered > 0 ? times / count : 1.0;
  return shares;
}

std::vector<SurveyCase> cases_of(const RecommendationSurvey& survey, bool was_tuned_on) {
  std::vector<SurveyCase> cases;
  std::ranges::copy_if(survey.cases, std::back_inserter(cases),
                       [&](const SurveyCase& one) { return one.was_tuned_on == was_tuned_on; });
  return cases;
}

std::vector<SurveyCase> worst_of(std::vector<SurveyCase> cases, std::size_t count) {
  std::erase_if(cases, [](const SurveyCase& one) { return !(one.badness() > 0.0); });
  std::ranges::stable_sort(cases, std::greater(), &SurveyCase::badness);
  cases.resize(std::min(cases.size(), count));
  return cases;
}

}  // namespace lightproof
