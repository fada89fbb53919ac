#include "lightproof/results/verdict.h"

#include <fmt/format.h>

namespace lightproof {

void Tally::add(Outcome outcome) {
  if (outcome == Outcome::not_run) {
    ++not_run;
    return;
  }
  ++tests;
  if (outcome == Outcome::reject) ++rejected;
  if (outcome == Outcome::inconclusive) ++inconclusive;
  if (outcome == Outcome::resolution_limited) ++limited;
}

Outcome Tally::outcome() const {
  if (rejected > 0) return Outcome::reject;
  if (inconclusive > 0 || tests == 0) return Outcome::inconclusive;
  return limited > 0 ? Outcome::resolution_limited : Outcome::accept;
}

Tally deciding_tally(const GateResult& gate, bool count_known_defects) {
  return tally_of(
      gate, [&](const TestRecord& test) { return count_known_defects || !test.known_defect; });
}

Tally known_defect_tally(const GateResult& gate) {
  return tally_of(gate, [](const TestRecord& test) { return test.known_defect; });
}

Outcome overall_outcome(const GateResult& gate, bool count_known_defects) {
  return deciding_tally(gate, count_known_defects).outcome();
}

std::string limited_text(const Tally& tally) {
  return (tally.limited > 0 ? fmt::format(", {} resolution-limited", tally.limited) : "") +
         (tally.not_run > 0 ? fmt::format(", {} not run", tally.not_run) : "");
}

}  // namespace lightproof
