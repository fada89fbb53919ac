// What to do: the cheapest method that reaches the error, a row for each map.
#include <fmt/format.h>

#include <cmath>

#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/accuracy_findings.h"
#include "lightproof/report/sections.h"
#include "lightproof/report/survey_html.h"
#include "lightproof/results/accuracy_reading.h"

namespace lightproof {
namespace {

Cell error_cell(const RecommendedMethod& method) {
  if (std::isnan(method.measured_error)) {
    return {fmt::format("{}{} predicted", method.is_upper_bound ? "at most " : "",
                        percent(method.predicted_error)),
            "number", "not measured"};
  }
  const std::string predicted =
      std::isnan(method.predicted_error)
          ? "not predicted"
          : fmt::format("{}{} predicted", method.is_upper_bound ? "at most " : "",
                        percent(method.predicted_error));
  return {percent_with_error(method.measured_error, method.measured_error_error) + " measured",
          "number", predicted};
}

/// "environment B, 64 samples".
std::string name_of(const RecommendedMethod& method) {
  if (!method.has_samples) return method.estimator;
  return fmt::format("{}, {}", method.estimator, counted(method.samples, "sample"));
}

std::string choice_text(const RecommendedMethod& method, double error) {
  return fmt::format("{}, for {} error", name_of(method), percent(error));
}

/// "3 MiB, 512×256".
std::string memory_text(const RecommendedMethod& method) {
  const std::string bytes = bytes_text(static_cast<double>(method.bytes));
  return method.table.width > 0 ? fmt::format("{}, table {}", bytes, extent_text(method.table))
                                : bytes;
}

Cell time_cell_of(double known, double predicted) {
  return {seconds_text(1e-3 * known), "number", seconds_text(1e-3 * predicted) + " predicted"};
}

std::string rival_text(const std::optional<RecommendedMethod>& rival) {
  if (!rival) return "none";
  return fmt::format("{}, {}", name_of(*rival), seconds_text(1e-3 * rival->known_time().point));
}

std::string reasons_text(const std::vector<UnreachedFamily>& unreached) {
  std::string text;
  for (const UnreachedFamily& family : unreached) {
    text +=
        fmt::format("{}{}: {}", text.empty() ? "" : "; ", to_string(family.family), family.reason);
  }
  return text;
}

void add_row(Table& table, const Recommendation& r) {
  const std::string why = r.warning.empty() ? r.reason : r.reason + " Note: " + r.warning;
  const MethodTime& known = r.choice.known_time();
  table.add({text_cell(r.question.map),
             {choice_text(r.choice, r.question.error), "take", ""},
             text_cell(r.question.receiver + ", " + r.question.material),
             error_cell(r.choice),
             time_cell_of(known.point, r.choice.predicted_time.point),
             time_cell_of(known.set_up, r.choice.predicted_time.set_up),
             {memory_text(r.choice), "number", ""},
             {rival_text(r.runner_up), "detail", ""},
             {why, "detail", ""}});
}

void add_row(Table& table, const RefusedRecommendation& r) {
  const Cell none = {"\u2013", "number", ""};
  table.add({text_cell(r.question.map),
             {fmt::format("no method reaches {} error", percent(r.question.error)), "take", ""},
             text_cell(r.question.receiver + ", " + r.question.material),
             none,
             none,
             none,
             none,
             {"none", "detail", ""},
             {reasons_text(r.unreached), "detail", ""}});
}

std::string recommendation_table(const StudyResult& study) {
  Table table("Recommendations", {"Map", "Take", "Receiver, material", "Error", "Time", "Set-up",
                                  "Memory", "Runner-up", "Why"});
  for (const Recommendation& r : study.recommendations) add_row(table, r);
  for (const RefusedRecommendation& r : study.refused_recommendations) add_row(table, r);
  return table.html();
}

/// Families that do not reach the error, and what stops them.
std::string unreached_html(const std::vector<Recommendation>& recommendations) {
  Table table("Out of reach", {"Map", "Receiver, material", "Family", "What stops it"});
  std::size_t count = 0;
  for (const Recommendation& r : recommendations) {
    for (const UnreachedFamily& family : r.unreached) {
      ++count;
      table.add({text_cell(r.question.map),
                 text_cell(r.question.receiver + ", " + r.question.material),
                 text_cell(std::string(to_string(family.family))),
                 {family.reason, "detail", ""}});
    }
  }
  return count == 0 ? "" : collapsible("Families that do not reach the error", table.html());
}

/// Without recommendations: what was fastest as it was measured.
std::string measured_table(const std::vector<AccuracyChart>& charts) {
  Table table("Fastest as measured",
              {"Map", "Take", "Receiver, material", "Time of a shading point", "Set-up", "Memory"});
  for (const AccuracyChart& chart : charts) {
    const std::optional<FastestLine> fastest = fastest_to(chart, kUsualError);
    if (!fastest) continue;
    const AccuracyLine& line = *fastest->line;
    const auto samples = whole_samples(fastest->point);
    const std::string take =
        line.points.size() == 1
            ? fmt::format("{}, {} error", line.estimator, percent(fastest->point.error))
            : fmt::format("{}, {}, {} error", line.estimator, counted(samples, "sample"),
                          percent(kUsualError));
    table.add({text_cell(chart.map),
               {take, "take", ""},
               text_cell(chart.receiver + ", " + chart.material),
               {seconds_text(fastest->point.seconds), "number", ""},
               {seconds_text(line.set_up_seconds), "number", ""},
               {bytes_text(static_cast<double>(line.bytes)), "number", ""}});
  }
  return table.html();
}

constexpr std::string_view kMeasuredNote =
    "The fastest of all charted estimators to an error of 5\u00a0% (root mean square over the "
    "shading points, bias included, over the mean), as it was measured here, without its set-up.";
constexpr std::string_view kRecommendedNote =
    "The cheapest method that reaches the error (root mean square over the receiver's pixels, bias "
    "included, over the mean of the reference), predicted from the map and checked by a short run. "
    "Time is that of a processor for one shading point, without set-up.";

}  // namespace

std::string recommendation_section(const StudyResult& study) {
  const bool has_answers = !study.recommendations.empty() || !study.refused_recommendations.empty();
  if (!has_answers && study.accuracy.empty()) return "";
  std::string html = "<section id=\"recommendations\">\n<h2>What to do</h2>\n";
  if (!has_answers) {
    return html + measured_table(study.accuracy) + paragraph(kMeasuredNote, "note") +
           "</section>\n";
  }
  return html + recommendation_table(study) + paragraph(kRecommendedNote, "note") +
         unreached_html(study.recommendations) + survey_html(study.recommendation_survey) +
         "</section>\n";
}

}  // namespace lightproof
