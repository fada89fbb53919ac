#include "lightproof/history/trend_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lightproof/page/document.h"
#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"

namespace lightproof {
namespace {

constexpr std::string_view kHowToRead =
    "A point is one commit: the median over sessions of the medians over runs. Black lines are the "
    "levels, dashed red lines the changes between them. Time is compared across sessions here, so "
    "a change may be the machine's; whether a commit is to blame is for `lightproof history "
    "compare` to say, on interleaved runs. A change of time is marked where two levels of at least "
    "five commits differ by more than 5\u00a0%, and more clearly than those of commits that all "
    "perform alike would seem to, even if a slow or fast state of the machine lasts for many "
    "sessions (correlations of neighbours of up to 0.9). Over all lines of time of this page "
    "(Holm's procedure), commits that all perform alike get any mark once in twenty pages at most. "
    "Instruction counts have no noise: every step beyond 1\u00a0% is marked.";

std::string short_commit(const std::string& commit) { return commit.substr(0, 12); }

std::string change_text(const ChangePoint& change) {
  return fmt::format("{} {} since", percent(std::abs(change.ratio - 1.0)),
                     change.ratio > 1.0 ? "more" : "less");
}

std::string finding_of(const TrendLine& line) {
  if (line.points.size() < 2) return "measured once";
  if (line.changes.empty()) {
    return fmt::format("no change over {}", counted(line.points.size(), "commit"));
  }
  const ChangePoint& last = line.changes.back();
  return fmt::format("{} {}", change_text(last), short_commit(line.points[last.first].commit));
}

std::string headline(std::span<const TrendLine> lines) {
  const auto changed = std::count_if(lines.begin(), lines.end(),
                                     [](const TrendLine& line) { return !line.changes.empty(); });
  if (lines.empty()) return "Nothing has been measured yet";
  if (changed == 0) {
    return fmt::format("None of {} has changed its level", counted(lines.size(), "line"));
  }
  return fmt::format("{} of {} changed {} level",
                     with_thousands(static_cast<std::uint64_t>(changed)),
                     counted(lines.size(), "line"), changed == 1 ? "its" : "their");
}

std::string changes_table(std::span<const TrendLine> lines) {
  Table table("Changes", {"Benchmark", "Metric", "Since commit", "Number", "Change", "log10 p"});
  bool any = false;
  for (const TrendLine& line : lines) {
    for (const ChangePoint& change : line.changes) {
      any = true;
      const std::string sign = change.ratio > 1.0 ? "+" : "\u2212";
      table.add(
          {text_cell(line.benchmark),
           text_cell(to_string(line.metric)),
           text_cell(short_commit(line.points[change.first].commit)),
           number_cell(static_cast<double>(change.first + 1)),
           {sign + percent(std::abs(change.ratio - 1.0)), "number", ""},
           {std::isinf(change.log10_p) ? "exact" : format_number(change.log10_p), "number", ""}});
    }
  }
  return any ? "<h3>Changes</h3>\n" + table.html() : "";
}

std::string quoted(const std::string& text) {
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + "\"";
}

std::string points_csv(std::span<const TrendLine> lines) {
  std::string csv = "machine,compiler,flags,benchmark,metric,number,commit,value,runs\n";
  for (const TrendLine& line : lines) {
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const TrendPoint& point = line.points[i];
      csv +=
          fmt::format("{},{},{},{},{},{},{},{},{}\n", quoted(line.machine), quoted(line.compiler),
                      quoted(line.flags), quoted(line.benchmark), to_string(line.metric), i + 1,
                      quoted(point.commit), point.value, point.runs);
    }
  }
  return csv;
}

auto setting_of(const TrendLine& line) {
  return std::tie(line.machine, line.compiler, line.flags, line.metric);
}

std::string figure_of(const TrendLine& line, std::size_t number) {
  const Chart chart = {fmt::format("trend-{}", number), line.benchmark + ": " + finding_of(line),
                       fmt::format("{} of {} over commits", to_string(line.metric), line.benchmark),
                       "", trend_chart(line)};
  return chart_figure(chart, "", true);
}

std::string section_heading(const TrendLine& line) {
  return fmt::format("<h2>{}</h2>\n", line.metric == Metric::nanoseconds ? "Time"
                                      : line.metric == Metric::error     ? "Error"
                                                                         : "Instructions") +
         paragraph(fmt::format("{}; {}; {}", line.machine, line.compiler, line.flags), "note");
}

/// One section per setting and metric.
std::string chart_sections(std::span<const TrendLine> lines) {
  std::string html;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i == 0 || setting_of(lines[i]) != setting_of(lines[i - 1])) {
      html += i == 0 ? "<section>\n" : "</div>\n</section>\n<section>\n";
      html += section_heading(lines[i]) + "<div class=\"multiples trends\">\n";
    }
    html += figure_of(lines[i], i + 1);
  }
  return lines.empty() ? "" : html + "</div>\n</section>\n";
}

}  // namespace

std::string trend_page(std::span<const TrendLine> lines, std::string_view version) {
  const std::string title = headline(lines);
  const std::string body =
      "<header>\n<p class=\"kicker\">Lightproof performance history</p>\n<h1>" + escaped(title) +
      "</h1>\n" +
      fmt::format("<p class=\"how\"><strong>How to read this.</strong> {}</p>\n",
                  escaped(kHowToRead)) +
      changes_table(lines) + "</header>\n" + chart_sections(lines) +
      download_link("history.csv", points_csv(lines));
  return html_document("Lightproof history: " + title, "", body, version);
}

}  // namespace lightproof
