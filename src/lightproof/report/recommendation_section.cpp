// What to do: the cheapest method that reaches the error, a row for each map.
#include <fmt/format.h>

#include <cmath>

#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/accuracy_findings.h"
#include "lightproof/report/sections.h"
#include "lightproof/results/accuracy_reading.h"

namespace lightproof {
namespace {

Cell error_cell(const RecommendedMethod& method) {
  if (std::isnan(method.measured_error)) {
    return {fmt::format("{}{} predicted", method.is_upper_bound ? "at most " : "",
                        percent(method.predicted_error)),
            "number", "not measured"};
  }
  return {percent_with_error(method.measured_error, method.measured_error_error) + " measured",
          "number", percent(method.predicted_error) + " predicted"};
}

/// "environment B, 64 samples".
std::string name_of(const RecommendedMethod& method) {
  if (!method.has_samples) return method.estimator;
  return fmt::format("{}, {}", method.estimator, counted(method.samples, "sample"));
}

std::string choice_text(const RecommendedMethod& method, double error) {
  return fmt::format("{}, {} error", name_of(method), percent(error));
}

/// "3 MiB, 512×256".
std::string memory_text(const RecommendedMethod& method) {
  const std::string bytes = bytes_text(static_cast<double>(method.bytes));
  return method.table.width > 0 ? fmt::format("{}, table {}", bytes, extent_text(method.table))
                                : bytes;
}

std::string rival_text(const std::optional<RecommendedMethod>& rival) {
  if (!rival) return "none";
  return fmt::format("{}, {}", name_of(*rival), seconds_text(1e-3 * rival->milliseconds));
}

std::string recommendation_table(const std::vector<Recommendation>& recommendations) {
  Table table("Recommendations", {"Map", "Take", "Receiver, material", "Error", "Time", "Set-up",
                                  "Memory", "Runner-up", "Why"});
  for (const Recommendation& r : recommendations) {
    const std::string why = r.warning.empty() ? r.reason : r.reason + " Note: " + r.warning;
    table.add({text_cell(r.map),
               {choice_text(r.choice, r.error), "take", ""},
               text_cell(r.receiver + ", " + r.material),
               error_cell(r.choice),
               {seconds_text(1e-3 * r.choice.milliseconds), "number", ""},
               {seconds_text(1e-3 * r.choice.set_up_milliseconds), "number", ""},
               {memory_text(r.choice), "number", ""},
               {rival_text(r.runner_up), "detail", ""},
               {why, "detail", ""}});
  }
  return table.html();
}

/// Families that do not reach the error, and what stops them.
std::string unreached_html(const std::vector<Recommendation>& recommendations) {
  Table table("Out of reach", {"Map", "Receiver, material", "Family", "What stops it"});
  std::size_t count = 0;
  for (const Recommendation& r : recommendations) {
    for (const UnreachedFamily& family : r.unreached) {
      ++count;
      table.add({text_cell(r.map),
                 text_cell(r.receiver + ", " + r.material),
                 text_cell(family.family),
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
    const auto samples = whole_samples(fastest->place);
    const std::string take =
        line.points.size() == 1
            ? fmt::format("{}, {} error", line.estimator, percent(fastest->place.error))
            : fmt::format("{}, {}, {} error", line.estimator, counted(samples, "sample"),
                          percent(kUsualError));
    table.add({text_cell(chart.map),
               {take, "take", ""},
               text_cell(chart.receiver + ", " + chart.material),
               {seconds_text(fastest->place.seconds), "number", ""},
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
    "Time "
    "is that of one shading point, without set-up.";

}  // namespace

std::string recommendation_section(const StudyResult& study) {
  if (study.recommendations.empty() && study.accuracy.empty()) return "";
  std::string html = "<section id=\"recommendations\">\n<h2>What to do</h2>\n";
  if (study.recommendations.empty()) {
    return html + measured_table(study.accuracy) + paragraph(kMeasuredNote, "note") +
           "</section>\n";
  }
  return html + recommendation_table(study.recommendations) + paragraph(kRecommendedNote, "note") +
         unreached_html(study.recommendations) + "</section>\n";
}

}  // namespace lightproof
