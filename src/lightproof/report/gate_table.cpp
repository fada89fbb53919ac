#include "lightproof/report/gate_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "lightproof/core/text_escapes.h"
#include "lightproof/page/numbers.h"
#include "lightproof/page/text_table.h"
#include "lightproof/report/ci_outputs.h"
#include "lightproof/report/effects.h"
#include "lightproof/report/gate_summary.h"

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
    rows.push_back({outcome_text(cell.tally.outcome()), cell.sampler_and_density, cell.map,
                    tally_text(cell.tally), full_name(worst.test), log10_p_text(worst),
                    effect_text(worst), minimum_detectable_text(worst)});
  }
  const std::vector<std::string> lines = aligned_lines(rows);
  std::string text = lines[0] + "\n";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    text += painted(lines[i + 1], cells[i].tally.outcome(), colour) + "\n";
  }
  return text;
}

/// "statistic 1031, 1023 degrees of freedom, log10 p -0.37, …": what the test has.
std::string figures_of(const TestRecord& test) {
  std::string text;
  if (test.log10_p) {
    text += fmt::format("statistic {}, ", significant(test.statistic, 6));
    if (test.dof > 0.0) text += fmt::format("{} degrees of freedom, ", significant(test.dof, 6));
    text += fmt::format("log10 p {}", significant(*test.log10_p));
  } else {
    text += "exact check";
  }
  text += ", effect " + effect_text(test);
  if (test.minimum_detectable_effect)
    text += ", minimum detectable " + minimum_detectable_text(test);
  return text + fmt::format(", {} samples", with_thousands(test.samples));
}

std::string full_text(const TestRecord& test) {
  std::string text = terminal_text(fmt::format("{} on {}: {}", sampler_and_density(test), test.map,
                                               full_name(test.test))) +
                     "\n    " + figures_of(test);
  if (!test.detail.empty()) text += "\n    " + terminal_text(test.detail);
  return text + "\n";
}

std::string diagnosis_lines(const GateResult& gate) {
  std::string text;
  for (const Rejection& r : gate.rejections) {
    text += terminal_text(fmt::format("{} {} on {} looks like: {} ({})", r.sampler, r.density_space,
                                      r.map, r.diagnosis, r.looks_like));
    if (!r.confidence.empty()) text += "\n    " + terminal_text(r.confidence);
    text += "\n    again: " + replay_command(gate, r) + "\n";
  }
  const bool is_on_map = gate.tests.empty() || gate.tests.front().map != kDirections;
  for (const Recognition& recognition : gate.recognitions) {
    text += fmt::format("The samples match the {} {}{}{}\n", is_on_map ? "map" : "distribution",
                        recognition.words, recognition.options.empty() ? "" : ": ",
                        recognition.options);
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

std::string left_out_lines(const GateResult& gate) {
  std::string text;
  for (const LeftOutGroup& group : left_out_groups(gate)) {
    text += fmt::format("  {}: {}: {}\n", group.map, group.reason, fmt::join(group.samplers, ", "));
  }
  return text.empty() ? "" : "\nLeft out\n" + text;
}

std::string all_lines(const GateResult& gate, Colour colour) {
  return summary_lines(gate, colour) + rejected_lines(gate, colour) + limited_lines(gate) +
         diagnosis_lines(gate);
}

/// The results on samplers with known defects, without colours, which mean a verdict.
std::string demonstration_lines(const GateResult& known_defects) {
  if (known_defects.tests.empty()) return "";
  return fmt::format("\n{}\n", kDemonstration) + all_lines(known_defects, Colour::off);
}

}  // namespace

/// What an accepting run could have seen, by the weakest of its tests of the bins.
std::string power_text(const GateResult& gate) {
  double weakest = 0.0;
  for (const TestRecord& test : gate.tests) {
    if (decides_power(test.test)) {
      weakest = std::max(weakest, test.minimum_detectable_effect.value_or(0.0));
    }
  }
  if (weakest <= 0.0) return "";
  return fmt::format(
      "\nwould have seen, with {:.0f} % probability, bins that are off by {} % (root mean square) "
      "or more",
      100.0 * kDetectionPower, significant(100.0 * weakest));
}

std::string gate_table(const GateResult& gate, bool count_known_defects, Colour colour) {
  const SplitGate split = split_gate(gate, count_known_defects);
  const Tally all = tally_of(split.deciding, [](const TestRecord&) { return true; });
  const std::string total = fmt::format(
      "{}: {}, {} rejected, {} inconclusive{}; family-wise error {}, {} samples per run, "
      "seed {}",
      outcome_text(all.outcome()), counted(all.tests, "test"), all.rejected, all.inconclusive,
      limited_text(all), significant(gate.family_alpha), with_thousands(gate.samples), gate.seed);
  return all_lines(split.deciding, colour) + demonstration_lines(split.known_defects) +
         left_out_lines(gate) + "\n" + painted(total, all.outcome(), colour) +
         power_text(split.deciding) + "\n";
}

}  // namespace lightproof
