#include "lightproof/report/table.h"

#include <fmt/format.h>

#include <vector>

#include "lightproof/report/ci_outputs.h"
#include "lightproof/report/columns.h"
#include "lightproof/report/gate_summary.h"
#include "lightproof/report/numbers.h"

namespace lightproof {
namespace {

std::string painted(const std::string& text, Outcome outcome, Colour colour) {
  if (colour == Colour::off) return text;
  const int code = outcome == Outcome::accept ? 32 : outcome == Outcome::reject ? 31 : 33;
  return fmt::format("\x1b[{}m{}\x1b[0m", code, text);
}

std::string log10_p_text(const TestRecord& test) {
  return test.log10_p ? significant(*test.log10_p) : "exact";
}

std::string detectable_text(const TestRecord& test) {
  return test.detectable_effect ? significant(*test.detectable_effect) : "-";
}

std::string tally_text(const Tally& tally) {
  const std::size_t passed = tally.tests - tally.rejected - tally.inconclusive - tally.limited;
  return fmt::format("{}/{}", passed, tally.tests);
}

std::string summary_lines(const GateResult& gate, Colour colour) {
  const std::vector<GateCell> cells = summarise(gate);
  TextRows rows = {
      {"verdict", "sampler", "map", "passed", "worst test", "log10 p", "effect", "detectable"}};
  for (const GateCell& cell : cells) {
    const TestRecord& worst = *cell.worst;
    rows.push_back({outcome_text(cell.tally.outcome()),
                    cell.configuration + (cell.known_defect ? " *" : ""), cell.map,
                    tally_text(cell.tally), worst.oracle + "/" + worst.test, log10_p_text(worst),
                    significant(worst.effect), detectable_text(worst)});
  }
  const std::vector<std::string> lines = aligned_lines(rows);
  std::string text = lines[0] + "\n";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    text += painted(lines[i + 1], cells[i].tally.outcome(), colour) + "\n";
  }
  return text;
}

std::string full_text(const TestRecord& test) {
  std::string text = fmt::format(
      "{} on {}: {}/{}\n    statistic {}, dof {}, log10 p {}, effect {}, detectable {}, {} samples",
      configuration_name(test), test.map, test.oracle, test.test, significant(test.statistic, 6),
      significant(test.dof, 6), log10_p_text(test), significant(test.effect), detectable_text(test),
      with_thousands(test.samples));
  if (!test.detail.empty()) text += "\n    " + test.detail;
  return text + "\n";
}

std::string diagnosis_lines(const GateResult& gate) {
  std::string text;
  for (const Rejection& r : gate.rejections) {
    text += fmt::format("{} {} on {} looks like: {} ({})\n", r.sampler, r.weighting, r.map,
                        r.diagnosis, r.looks_like);
    text += "    again: " + replay_command(gate, r) + "\n";
  }
  return text.empty() ? "" : "\nDiagnosis\n" + text;
}

std::string rejected_lines(const GateResult& gate, Colour colour) {
  std::string text;
  for (const TestRecord& test : gate.tests) {
    if (test.outcome != Outcome::reject) continue;
    text += painted("\u2717 " + full_text(test), test.outcome, colour);
  }
  return text.empty() ? "" : "\nRejected tests\n" + text;
}

std::string limited_lines(const GateResult& gate) {
  std::string text;
  for (const TestRecord& test : gate.tests) {
    if (test.outcome == Outcome::resolution_limited) text += full_text(test);
  }
  return text.empty() ? "" : "\nResolution-limited tests\n" + text;
}

}  // namespace

std::string gate_table(const GateResult& gate, bool count_known_defects, Colour colour) {
  const Tally all = count_known_defects ? tally_of(gate, [](const TestRecord&) { return true; })
                                        : deciding_tally(gate);
  const Tally known = count_known_defects ? Tally{} : known_defect_tally(gate);
  std::string total = fmt::format(
      "{}: {}, {} rejected, {} inconclusive{}; family-wise error {}, {} samples per "
      "configuration, seed {}",
      outcome_text(all.outcome()), counted(all.tests, "test"), all.rejected, all.inconclusive,
      limited_text(all), significant(gate.family_alpha), with_thousands(gate.samples), gate.seed);
  if (known.tests > 0) {
    total += fmt::format("\n* kept as published, with known defects: {} of {} rejected",
                         known.rejected, counted(known.tests, "test"));
  }
  return summary_lines(gate, colour) + rejected_lines(gate, colour) + limited_lines(gate) +
         diagnosis_lines(gate) + "\n" + painted(total, all.outcome(), colour) + "\n";
}

}  // namespace lightproof
