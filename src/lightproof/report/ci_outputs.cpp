#include "lightproof/report/ci_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "lightproof/core/text_escapes.h"
#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/effects.h"
#include "lightproof/report/gate_summary.h"

namespace lightproof {
namespace {

constexpr std::size_t kMarkdownLimit = 60000;
constexpr std::size_t kAnnotations = 9;

bool counts(const TestRecord& test, bool count_known_defects) {
  return count_known_defects || !test.known_defect;
}

/// "log10 p -20.3", "exact check".
std::string probability_of(const TestRecord& test) {
  return test.log10_p ? "log10 p " + significant(*test.log10_p) : std::string("exact check");
}

std::string diagnosis_of(const GateResult& gate, const TestRecord& test) {
  for (const Rejection& r : gate.rejections) {
    if (r.sampler == test.sampler && r.density_space == test.density_space && r.map == test.map) {
      return r.diagnosis + " (" + r.looks_like + ")";
    }
  }
  return "";
}

/// Rejections that count, the least likely first; exact checks before all.
std::vector<const TestRecord*> worst_rejections(const GateResult& gate, bool count_known_defects) {
  std::vector<const TestRecord*> rejected;
  for (const TestRecord& test : gate.tests) {
    if (test.outcome == Outcome::reject && counts(test, count_known_defects)) {
      rejected.push_back(&test);
    }
  }
  std::stable_sort(rejected.begin(), rejected.end(), [](const auto* a, const auto* b) {
    return a->log10_p.value_or(-1e308) < b->log10_p.value_or(-1e308);
  });
  return rejected;
}

std::string message_of(const GateResult& gate, const TestRecord& test) {
  std::string text = fmt::format("{}, effect {}", probability_of(test), effect_text(test));
  if (!test.detail.empty()) text += "; " + test.detail;
  const std::string diagnosis = diagnosis_of(gate, test);
  if (!diagnosis.empty()) text += "; looks like: " + diagnosis;
  return text;
}

std::string junit_case(const GateResult& gate, const TestRecord& test, bool count_known_defects) {
  std::string xml = fmt::format(
      "    <testcase classname=\"{}\" name=\"{}\">\n      <properties>\n", escaped(test.sampler),
      escaped(fmt::format("{}/{}/{}", test.density_space, test.map, full_name(test.test))));
  const auto property = [&](std::string_view name, const std::string& value) {
    xml += fmt::format("        <property name=\"{}\" value=\"{}\"/>\n", name, escaped(value));
  };
  if (test.log10_p) {
    property("p", p_text(*test.log10_p));
    property("log10_p", fmt::format("{:.6g}", *test.log10_p));
  }
  property("effect", effect_text(test));
  if (test.minimum_detectable_effect) property("minimum_detectable", minimum_detectable_text(test));
  property("samples", std::to_string(test.samples));
  property("seed", std::to_string(test.seed));
  property("replay", replay_command(gate, test));
  xml += "      </properties>\n";
  const std::string message = escaped(message_of(gate, test));
  if (test.outcome == Outcome::reject && counts(test, count_known_defects)) {
    xml += fmt::format("      <failure message=\"{}\">{}\n{}</failure>\n", message, message,
                       escaped(replay_command(gate, test)));
  } else if (test.outcome == Outcome::not_run) {
    xml += fmt::format("      <skipped message=\"not run: {}\"/>\n", escaped(test.detail));
  } else if (test.outcome == Outcome::resolution_limited) {
    xml += fmt::format("      <skipped message=\"resolution-limited: {}\"/>\n", message);
  } else if (test.outcome == Outcome::inconclusive && counts(test, count_known_defects)) {
    xml += fmt::format("      <error message=\"inconclusive: {}\"/>\n", message);
  } else if (test.outcome != Outcome::accept) {
    xml += fmt::format("      <skipped message=\"known defect: {}\"/>\n", message);
  }
  return xml + "    </testcase>\n";
}

/// A sampler that the map's mapping does not allow, as a case that was skipped.
std::string junit_case(const LeftOut& left_out) {
  return fmt::format(
      "    <testcase classname=\"{}\" name=\"{}\">\n      <skipped message=\"left out: {}\"/>\n"
      "    </testcase>\n",
      escaped(left_out.sampler),
      escaped(fmt::format("{}/{}", left_out.density_space, left_out.map)),
      escaped(left_out.reason));
}

/// The reasons for which samplers were left out, each with how many it was, in words.
std::vector<std::string> left_out_sentences(const GateResult& gate) {
  std::vector<std::string> sentences;
  std::vector<LeftOut> kinds;  // one of each map, density and reason
  for (const LeftOut& one : gate.left_out) {
    const auto is_like = [&](const LeftOut& other) {
      return other.map == one.map && other.density_space == one.density_space &&
             other.reason == one.reason;
    };
    if (std::ranges::any_of(kinds, is_like)) continue;
    kinds.push_back(one);
    const auto count = std::ranges::count_if(gate.left_out, is_like);
    sentences.push_back(fmt::format("{}, density {}: {} left out: {}", one.map, one.density_space,
                                    counted(static_cast<std::size_t>(count), "sampler"),
                                    one.reason));
  }
  return sentences;
}

std::string markdown_row(const GateResult& gate, const TestRecord& test) {
  return fmt::format("| {} | {} | {} | {} | {} | {} |\n", markdown_text(sampler_and_density(test)),
                     markdown_text(test.map), markdown_text(full_name(test.test)),
                     probability_of(test), effect_text(test),
                     markdown_text(diagnosis_of(gate, test)));
}

/// Samplers on maps that were rejected, the least likely worst test first; exact checks before all.
std::vector<GateCell> rejected_cells(const GateResult& gate) {
  std::vector<GateCell> cells = summarise(gate);
  std::erase_if(cells, [](const GateCell& cell) { return cell.tally.rejected == 0; });
  std::stable_sort(cells.begin(), cells.end(), [](const GateCell& a, const GateCell& b) {
    return a.worst->log10_p.value_or(-1e308) < b.worst->log10_p.value_or(-1e308);
  });
  return cells;
}

/// One defect, however many tests see it.
std::string annotation(const GateResult& gate, const GateCell& cell) {
  const TestRecord& worst = *cell.worst;
  const std::string title = fmt::format("lightproof: {} on {}", cell.sampler_and_density, cell.map);
  const std::string message =
      fmt::format("{} of {} rejected, the worst {}: {}. Again: {}", cell.tally.rejected,
                  counted(cell.tally.tests, "test"), full_name(worst.test), message_of(gate, worst),
                  replay_command(gate, worst));
  return fmt::format("::error title={}::{}\n", workflow_property(title), workflow_message(message));
}

}  // namespace

std::string replay_command(const GateResult& gate, const TestRecord& test) {
  if (!gate.replay.empty()) return gate.replay;
  // Distributions over directions have no density of a map and need no map.
  const bool of_map = !test.density_space.empty();
  std::string options = gate.sequential ? " --sequential" : "";
  if (gate.family > 0) options += fmt::format(" --family {}", gate.family);
  if (gate.must_detect != kMustDetect)
    options += fmt::format(" --must-detect {}", gate.must_detect);
  const std::string map = shell_word(test.source.empty() ? test.map : test.source);
  const auto third_party =
      std::ranges::find(gate.third_party_samplers, test.sampler, &ThirdPartySampler::name);
  const std::string sampler = third_party != gate.third_party_samplers.end()
                                  ? third_party->options
                                  : "--sampler " + shell_word(test.sampler);
  return fmt::format("lightproof gate{} {}{} --samples {} --seed {}{}", of_map ? " " + map : "",
                     sampler, of_map ? " --density " + test.density_space + gate.input_options : "",
                     gate.samples, gate.seed, options);
}

std::string replay_command(const GateResult& gate, const Rejection& rejection) {
  const auto test = std::find_if(gate.tests.begin(), gate.tests.end(), [&](const TestRecord& t) {
    return t.sampler == rejection.sampler && t.density_space == rejection.density_space &&
           t.map == rejection.map;
  });
  return test == gate.tests.end() ? "" : replay_command(gate, *test);
}

std::string gate_junit(const GateResult& gate, bool count_known_defects) {
  std::size_t failures = 0;
  std::size_t errors = 0;
  std::size_t skipped = 0;
  std::string cases;
  for (const TestRecord& test : gate.tests) {
    if (test.outcome == Outcome::resolution_limited || test.outcome == Outcome::not_run) {
      ++skipped;
    } else if (test.outcome != Outcome::accept) {
      const bool rejected = test.outcome == Outcome::reject;
      ++(!counts(test, count_known_defects) ? skipped : rejected ? failures : errors);
    }
    cases += junit_case(gate, test, count_known_defects);
  }
  for (const LeftOut& left_out : gate.left_out) cases += junit_case(left_out);
  skipped += gate.left_out.size();
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
      "  <testsuite name=\"lightproof gate\" tests=\"{}\" failures=\"{}\" errors=\"{}\" "
      "skipped=\"{}\">\n{}  </testsuite>\n</testsuites>\n",
      gate.tests.size() + gate.left_out.size(), failures, errors, skipped, cases);
}

std::string gate_markdown(const GateResult& gate, bool count_known_defects) {
  const Tally tally =
      tally_of(gate, [&](const TestRecord& test) { return counts(test, count_known_defects); });
  std::string text = fmt::format(
      "### Lightproof gate: {}\n\n{}, {} rejected, {} inconclusive{}; family-wise error {}, {} "
      "samples per run, seed {}.\n",
      outcome_text(tally.outcome()), counted(tally.tests, "test"), tally.rejected,
      tally.inconclusive, limited_text(tally), significant(gate.family_alpha),
      with_thousands(gate.samples), gate.seed);
  for (const std::string& sentence : left_out_sentences(gate)) {
    text += fmt::format("\n{}.\n", markdown_text(sentence));
  }
  const auto rejected = worst_rejections(gate, count_known_defects);
  if (rejected.empty()) return text;
  text += "\n| sampler | map | test | p | effect | looks like |\n|---|---|---|---|---|---|\n";
  std::size_t shown = 0;
  for (; shown < rejected.size(); ++shown) {
    const std::string row = markdown_row(gate, *rejected[shown]);
    if (text.size() + row.size() + 100 > kMarkdownLimit) break;
    text += row;
  }
  if (shown < rejected.size()) text += fmt::format("\nand {} more\n", rejected.size() - shown);
  return text;
}

std::string gate_annotations(const GateResult& gate, bool count_known_defects) {
  const GateResult deciding = split_gate(gate, count_known_defects).deciding;
  std::string text;
  std::size_t shown = 0;
  const std::vector<GateCell> rejected = rejected_cells(deciding);
  for (; shown < std::min(kAnnotations, rejected.size()); ++shown) {
    text += annotation(deciding, rejected[shown]);
  }
  if (shown < rejected.size()) {
    text += fmt::format("::error title=lightproof::{} more rejected: see the summary or the log\n",
                        counted(rejected.size() - shown, "run"));
  }
  const Tally tally = tally_of(deciding, [](const TestRecord&) { return true; });
  if (tally.inconclusive > 0) {
    text += fmt::format("::error title=lightproof::{} could not be judged\n",
                        counted(tally.inconclusive, "test"));
  }
  for (const std::string& sentence : left_out_sentences(gate)) {
    text += fmt::format("::notice title=lightproof::{}\n", workflow_message(sentence));
  }
  if (tally.limited > 0) {
    text += fmt::format("::warning title=lightproof::{} limited by the sampler's own resolution\n",
                        counted(tally.limited, "test"));
  }
  return text;
}

}  // namespace lightproof
