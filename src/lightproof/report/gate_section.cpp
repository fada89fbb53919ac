// The gate: every sampler against every map, and each test behind a verdict.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/csv.h"
#include "lightproof/report/effects.h"
#include "lightproof/report/gate_summary.h"
#include "lightproof/report/sections.h"

namespace lightproof {
namespace {

Cell outcome_cell(Outcome outcome) { return {outcome_text(outcome), to_string(outcome), ""}; }

Cell tally_cell(const GateCell& cell) {
  const Tally& tally = cell.tally;
  std::string text = outcome_text(tally.outcome());
  if (tally.rejected > 0) {
    text += fmt::format(" {}/{}", tally.rejected, tally.tests);
  } else if (tally.inconclusive > 0) {
    text += fmt::format(" {}/{}", tally.inconclusive, tally.tests);
  } else if (tally.limited > 0) {
    text += fmt::format(" {}/{}", tally.limited, tally.tests);
  }
  const std::string worst = fmt::format(
      "{}; worst: {}, log10 p {}", counted(tally.tests, "test"), full_name(cell.worst->test),
      cell.worst->log10_p ? significant(*cell.worst->log10_p) : std::string("none (exact check)"));
  return {text, to_string(tally.outcome()), worst};
}

/// Samplers of directions have no map: one verdict each.
std::string direction_table(const std::vector<GateCell>& cells) {
  Table table("Verdict of every warp and material", {"Sampler", "Verdict"}, "matrix");
  for (const GateCell& cell : cells) {
    table.add({text_cell(cell.sampler_and_density), tally_cell(cell)});
  }
  return cells.empty() ? "" : table.html();
}

/// What stands where a sampler has no verdict on a map.
Cell absent_cell(const std::vector<LeftOut>& left_out, const std::string& sampler_and_density,
                 const std::string& map) {
  for (const LeftOut& each : left_out) {
    if (each.map == map && each.sampler + " " + each.density_space == sampler_and_density) {
      return {"\u2013 left out", "absent", each.reason};
    }
  }
  return {"\u2013 not run", "absent", ""};
}

std::string matrix(const std::vector<GateCell>& cells, const std::vector<LeftOut>& left_out) {
  if (cells.empty()) return "";
  std::vector<std::string> maps;
  std::vector<std::string> tested;
  for (const GateCell& cell : cells) {
    maps.push_back(cell.map);
    tested.push_back(cell.sampler_and_density);
  }
  maps = unique_names(maps);
  std::vector<std::string> columns = {"Sampler"};
  columns.insert(columns.end(), maps.begin(), maps.end());
  Table table("Verdict of every sampler on every map", columns, "matrix");
  for (const std::string& name : unique_names(tested)) {
    std::vector<Cell> row = {text_cell(name)};
    for (const std::string& map : maps) {
      const auto found = std::find_if(cells.begin(), cells.end(), [&](const GateCell& c) {
        return c.sampler_and_density == name && c.map == map;
      });
      row.push_back(found == cells.end() ? absent_cell(left_out, name, map) : tally_cell(*found));
    }
    table.add(row);
  }
  return table.html();
}

std::size_t count_tested(const std::vector<GateCell>& cells) {
  std::vector<std::string> names;
  for (const GateCell& cell : cells) names.push_back(cell.sampler_and_density);
  return unique_names(names).size();
}

/// What is accepted everywhere is a number, which opens on a click.
template <class AsTable>
std::string folded(std::vector<GateCell> cells, std::string_view noun, const AsTable& table) {
  const std::vector<GateCell> all = cells;
  const auto is_open = [&](const GateCell& cell) {
    return std::any_of(all.begin(), all.end(), [&](const GateCell& c) {
      return c.sampler_and_density == cell.sampler_and_density &&
             c.tally.outcome() != Outcome::accept;
    });
  };
  const auto accepted = std::stable_partition(cells.begin(), cells.end(), is_open);
  const std::vector<GateCell> closed(accepted, cells.end());
  cells.erase(accepted, cells.end());
  if (closed.empty()) return table(cells);
  return table(cells) +
         collapsible(counted(count_tested(closed), noun) + " accepted everywhere", table(closed));
}

std::vector<std::string> test_columns() {
  return {"Sampler", "Map",    "Test",       "Verdict",   "Detail",
          "log10 p", "Effect", "Detectable", "Statistic", "Degrees of freedom",
          "Samples"};
}

Cell log10_p_cell(const TestRecord& test) {
  return test.log10_p ? number_cell(*test.log10_p) : Cell{"exact", "number", "no probability"};
}

Cell effect_cell(const TestRecord& test) {
  return is_of_worst_cell(test) ? Cell{effect_text(test), "number", ""} : number_cell(test.effect);
}

Cell minimum_detectable_cell(const TestRecord& test) {
  if (!test.minimum_detectable_effect) return {"\u2013", "number", ""};
  return is_of_worst_cell(test) ? Cell{minimum_detectable_text(test), "number", ""}
                                : number_cell(*test.minimum_detectable_effect);
}

std::vector<Cell> test_row(const TestRecord& t) {
  return {text_cell(sampler_and_density(t)),
          text_cell(t.map),
          text_cell(full_name(t.test)),
          outcome_cell(t.outcome),
          {t.detail, t.detail.empty() ? "" : "detail", ""},
          log10_p_cell(t),
          effect_cell(t),
          minimum_detectable_cell(t),
          number_cell(t.statistic, 5),
          t.dof > 0.0 ? number_cell(t.dof, 6) : Cell{"\u2013", "number", ""},
          {with_thousands(t.samples), "number", ""}};
}

template <class Selected>
std::string test_table(const GateResult& gate, const std::string& caption,
                       const Selected& selected) {
  Table table(caption, test_columns());
  for (const TestRecord& test : gate.tests) {
    if (selected(test)) table.add(test_row(test));
  }
  return table.html();
}

/// What one kind of test saw over all samplers and maps.
struct Sight {
  TestId test;
  Tally tally;
  double detectable = std::nan("");  ///< the largest over its runs
};

std::vector<Sight> sights(const GateResult& gate) {
  std::vector<Sight> kinds;
  for (const TestRecord& t : gate.tests) {
    auto kind =
        std::find_if(kinds.begin(), kinds.end(), [&](const Sight& s) { return s.test == t.test; });
    if (kind == kinds.end()) kind = kinds.insert(kinds.end(), Sight{t.test, {}});
    kind->tally.add(t.outcome);
    if (t.minimum_detectable_effect)
      kind->detectable = std::fmax(kind->detectable, *t.minimum_detectable_effect);
  }
  return kinds;
}

TestRecord worst_run_of(const Sight& sight) {
  TestRecord record;
  record.test = sight.test;
  if (!std::isnan(sight.detectable)) record.minimum_detectable_effect = sight.detectable;
  return record;
}

Cell with_tooltip(Cell cell, std::string_view tooltip) {
  cell.tooltip = tooltip;
  return cell;
}

std::string sight_table(const GateResult& gate) {
  Table table("What each kind of test saw and could have seen",
              {"Oracle", "Test", "Runs", "Rejected", "Inconclusive", "Not run",
               "Minimum detectable effect, worst run"});
  for (const Sight& s : sights(gate)) {
    const TestDescription& test = describe(s.test);
    table.add({text_cell(std::string(to_string(test.oracle))),
               {std::string(test.name), "", std::string(test.counts)},
               {with_thousands(s.tally.tests), "number", ""},
               {with_thousands(s.tally.rejected), "number", ""},
               {with_thousands(s.tally.inconclusive), "number", ""},
               {with_thousands(s.tally.not_run), "number", ""},
               with_tooltip(minimum_detectable_cell(worst_run_of(s)), meaning_of(test.effect))});
  }
  return table.html();
}

std::string tally_text(const Tally& tally) {
  std::string text = fmt::format("{} of {} rejected", with_thousands(tally.rejected),
                                 counted(tally.tests, "test"));
  if (tally.inconclusive > 0) text += fmt::format(", {} inconclusive", tally.inconclusive);
  return text + limited_text(tally);
}

std::string gate_title(const GateResult& gate) {
  const Tally deciding = deciding_tally(gate);
  const Tally known = known_defect_tally(gate);
  if (known.tests == 0) return tally_text(deciding);
  const std::string published = "samplers kept as published: " + tally_text(known);
  return deciding.tests == 0 ? published : tally_text(deciding) + "; " + published;
}

std::string diagnoses(const GateResult& gate) {
  if (gate.rejections.empty()) return "";
  Table table("What the rejected samplers look like",
              {"Sampler", "Map", "Looks like", "Worst bin (column, row)", "Standard deviations"});
  for (const Rejection& r : gate.rejections) {
    const std::vector<WorstBin> worst = worst_bins(r, 1);
    table.add({text_cell(r.density_space.empty() ? r.sampler : r.sampler + " " + r.density_space),
               text_cell(r.map),
               {r.diagnosis, "detail", r.looks_like},
               worst.empty() ? text_cell("\u2013")
                             : text_cell(fmt::format("{}, {}", worst[0].x, worst[0].y)),
               worst.empty() ? text_cell("\u2013") : number_cell(worst[0].residual)});
  }
  return "<h4>Diagnosis</h4>\n" + table.html();
}

/// Samplers that a map's own texels do not allow, and why.
std::string left_out_table(const GateResult& gate) {
  if (gate.left_out.empty()) return "";
  Table table("Samplers that were left out", {"Map", "Why", "Samplers"});
  for (const LeftOutGroup& group : left_out_groups(gate)) {
    table.add({text_cell(group.map),
               {group.reason, "detail", ""},
               {fmt::format("{}", fmt::join(group.samplers, ", ")), "detail", ""}});
  }
  return "<h4>Left out</h4>\n" + table.html();
}

std::string tests_that_are(const GateResult& gate, Outcome outcome, const std::string& heading) {
  const auto selected = [&](const TestRecord& test) { return test.outcome == outcome; };
  if (std::none_of(gate.tests.begin(), gate.tests.end(), selected)) return "";
  return fmt::format("<h4>{}</h4>\n", escaped(heading)) + test_table(gate, heading, selected);
}

/// Verdicts, diagnoses, and the tests behind those that are not accepted.
std::string verdicts(const GateResult& gate, const std::vector<LeftOut>& left_out) {
  std::vector<GateCell> cells = summarise(gate);
  const auto directions = std::stable_partition(
      cells.begin(), cells.end(), [](const GateCell& cell) { return cell.map != kDirections; });
  const std::vector<GateCell> of_directions(directions, cells.end());
  cells.erase(directions, cells.end());
  const auto matrix_of = [&](const std::vector<GateCell>& shown) {
    return matrix(shown, left_out);
  };
  return folded(std::move(cells), "sampler", matrix_of) +
         (of_directions.empty() ? "" : "<h4>Warps and materials</h4>\n") +
         folded(of_directions, "sampler", direction_table) + diagnoses(gate) +
         tests_that_are(gate, Outcome::reject, "Rejected tests") +
         tests_that_are(gate, Outcome::inconclusive, "Inconclusive tests") +
         tests_that_are(gate, Outcome::resolution_limited, "Resolution-limited tests");
}

/// Closed, so that nobody takes a demonstration for the verdict.
std::string demonstration(const GateResult& known_defects, const std::vector<LeftOut>& left_out) {
  if (known_defects.tests.empty()) return "";
  return collapsible(kDemonstration, verdicts(known_defects, left_out));
}

constexpr std::string_view kLegend =
    "A, B and C are the target densities. A, texture-space, draws texels in proportion to their "
    "luminance; B, solid-angle, and C, sine-weighted, in proportion to luminance times solid "
    "angle. "
    "Inside a texel B is uniform in solid angle, A and C are in (s,t). C is what pbrt-v3, Mitsuba "
    "and Cycles draw. Oracles: self compares the samples with the sampler's own pdf, "
    "reference with the map itself, mean and variance with integrals of the map; check needs no "
    "statistics. A fraction behind a verdict counts the tests that led to it. Effects are relative "
    "deviations, or Cohen's w of counts; of the worst texel, row or column they are its count over "
    "the expected one.";

}  // namespace

std::string gate_section(const GateResult& gate, const std::string& directions_origin) {
  std::string html = "<section id=\"gate\">\n<h2>Gate</h2>\n";
  if (gate.tests.empty()) {
    return html + paragraph("No test was run: run `lightproof gate` on these maps.", "empty") +
           "</section>\n";
  }
  html += fmt::format("<h3>{}</h3>\n", escaped(gate_title(gate)));
  const SplitGate split = split_gate(gate, false);
  html += paragraph(kLegend, "note") + verdicts(split.deciding, gate.left_out) +
          left_out_table(gate) + demonstration(split.known_defects, gate.left_out);
  if (!directions_origin.empty()) {
    html += paragraph(
        fmt::format("Warps and materials, which need no map: tested by this program on {}.",
                    directions_origin));
  }
  html += collapsible("What each kind of test could have seen", sight_table(gate));
  html += collapsible(fmt::format("All {}", counted(gate.tests.size(), "test")),
                      test_table(gate, "All tests", [](const TestRecord&) { return true; }));
  return html + download_link("gate.csv", gate_csv(gate)) + "</section>\n";
}

}  // namespace lightproof
