// The findings on the gate.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string_view>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/gate_summary.h"

namespace lightproof {
namespace {

std::size_t map_count(const GateResult& gate) {
  std::vector<std::string> maps;
  for (const TestRecord& test : gate.tests) {
    if (test.map != kDirections) maps.push_back(test.map);
  }
  return unique_names(maps).size();
}

std::string tests_of(const Tally& tally, std::string_view what) {
  const std::size_t count = what == "rejected" ? tally.rejected : tally.inconclusive;
  return fmt::format("{} of {} {}", with_thousands(count), counted(tally.tests, "test"), what);
}

using Judged = std::function<bool(const TestRecord&)>;

std::vector<std::string> samplers_of(const GateResult& gate, const Judged& judged) {
  std::vector<std::string> names;
  for (const TestRecord& test : gate.tests) {
    if (judged(test)) names.push_back(test.sampler);
  }
  return unique_names(names);
}

/// The samplers of which a test ended so.
std::vector<std::string> samplers_with(const GateResult& gate, const Judged& judged,
                                       Outcome outcome) {
  return samplers_of(
      gate, [&](const TestRecord& test) { return judged(test) && test.outcome == outcome; });
}

SamplerFinding sampler_finding(const GateResult& gate, const std::string& sampler) {
  const Tally tally =
      tally_of(gate, [&](const TestRecord& test) { return test.sampler == sampler; });
  SamplerFinding finding;
  finding.outcome = tally.outcome();
  const bool open = finding.outcome == Outcome::inconclusive;
  finding.sentence =
      fmt::format("{}: {}", sampler, tests_of(tally, open ? "inconclusive" : "rejected"));
  if (finding.outcome == Outcome::reject && tally.inconclusive > 0) {
    finding.sentence += fmt::format(", {} inconclusive", tally.inconclusive);
  }
  const bool known = std::any_of(gate.tests.begin(), gate.tests.end(), [&](const TestRecord& t) {
    return t.sampler == sampler && t.known_defect;
  });
  finding.is_demonstration = known;
  if (known) {
    finding.sentence +=
        finding.outcome == Outcome::accept || finding.outcome == Outcome::resolution_limited
            ? " (kept as published; its known defects were not seen)"
            : " (kept as published, with its known defects)";
  }
  if (finding.outcome == Outcome::resolution_limited) {
    finding.sentence +=
        fmt::format(", {} as far as its rounding lets be seen", counted(tally.limited, "test"));
  }
  if (finding.outcome == Outcome::accept || finding.outcome == Outcome::resolution_limited) {
    return finding;
  }
  for (const GateCell& cell : summarise(gate)) {
    if (cell.sampler != sampler || cell.worst->outcome != finding.outcome) continue;
    finding.sentence += fmt::format("; for example {} of {} on {}", full_name(cell.worst->test),
                                    cell.sampler_and_density, cell.map);
    if (!cell.worst->detail.empty()) finding.sentence += " (" + cell.worst->detail + ")";
    break;
  }
  return finding;
}

/// The finding on samplers of directions, all of which are accepted: they are many, and a line each
/// would hide the others.
SamplerFinding finding_on_directions(const GateResult& gate,
                                     const std::vector<std::string>& names) {
  if (names.size() == 1) return sampler_finding(gate, names.front());
  const Tally tally = tally_of(gate, [&](const TestRecord& test) {
    return std::count(names.begin(), names.end(), test.sampler) > 0;
  });
  SamplerFinding finding;
  finding.outcome = Outcome::accept;
  finding.sentence = fmt::format("{} samplers of directions (warps and materials): {}",
                                 names.size(), tests_of(tally, "rejected"));
  return finding;
}

/// The verdict on one sampler, or on several of them.
std::string verdict_on(const GateResult& gate, const Judged& judged, const Tally& tally) {
  const std::vector<std::string> guilty = samplers_with(gate, judged, tally.outcome());
  const std::size_t all = samplers_of(gate, judged).size();
  const std::string who = all == 1 ? guilty.front()
                          : guilty.size() == 1
                              ? guilty.front() + " alone"
                              : fmt::format("{} of {} samplers", guilty.size(), all);
  if (tally.outcome() == Outcome::inconclusive) {
    return fmt::format("the verdict on {} is open", all == 1 ? guilty.front() : who);
  }
  return fmt::format("{} {} not draw the right distribution", who,
                     guilty.size() == 1 ? "does" : "do");
}

}  // namespace

std::string headline(const StudyResult& study) {
  const GateResult& gate = study.gate;
  if (gate.tests.empty()) return "No test was run";
  const bool any_correct = std::any_of(gate.tests.begin(), gate.tests.end(),
                                       [](const TestRecord& t) { return !t.known_defect; });
  const Judged judged = [any_correct](const TestRecord& t) {
    return !any_correct || !t.known_defect;
  };
  const Tally tally = tally_of(gate, judged);
  const std::vector<std::string> samplers = samplers_of(gate, judged);
  const std::size_t maps = map_count(gate);
  const std::string where = fmt::format("On {} {}", count_word(maps), maps == 1 ? "map" : "maps");
  const std::string error = "at a family-wise error of " + significant(gate.family_alpha, 2);
  switch (tally.outcome()) {
    case Outcome::accept:
    case Outcome::resolution_limited:
      return fmt::format("{}, {} the right distribution{}: {} {}", where,
                         samplers.size() == 1
                             ? samplers.front() + " draws"
                             : fmt::format("all {} correct samplers draw", samplers.size()),
                         tally.limited > 0 ? " as far as rounding lets be seen" : "",
                         tests_of(tally, "rejected"), error);
    case Outcome::reject:
      return fmt::format("{}, {}: {} {}", where, verdict_on(gate, judged, tally),
                         tests_of(tally, "rejected"), error);
    case Outcome::inconclusive:
    case Outcome::not_run:
      break;
  }
  return fmt::format("{}, {}: {}, none rejected", where, verdict_on(gate, judged, tally),
                     tests_of(tally, "inconclusive"));
}

std::vector<SamplerFinding> sampler_findings(const GateResult& gate) {
  const auto draws_directions = [](const TestRecord& test) { return test.map == kDirections; };
  const std::vector<std::string> of_directions = samplers_of(gate, draws_directions);
  std::vector<std::string> accepted_directions;
  std::vector<SamplerFinding> findings;
  for (const std::string& sampler : samplers_of(gate, [](const TestRecord&) { return true; })) {
    SamplerFinding finding = sampler_finding(gate, sampler);
    const bool in_one_line = finding.outcome == Outcome::accept && !finding.is_demonstration &&
                             std::count(of_directions.begin(), of_directions.end(), sampler) > 0;
    if (in_one_line) {
      accepted_directions.push_back(sampler);
    } else {
      findings.push_back(std::move(finding));
    }
  }
  if (!accepted_directions.empty()) {
    findings.push_back(finding_on_directions(gate, accepted_directions));
  }
  return findings;
}

}  // namespace lightproof
