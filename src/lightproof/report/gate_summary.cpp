#include "lightproof/report/gate_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

namespace lightproof {
namespace {

int severity(Outcome outcome) {
  switch (outcome) {
    case Outcome::reject:
      return 0;
    case Outcome::inconclusive:
      return 1;
    case Outcome::resolution_limited:
      return 2;
    case Outcome::accept:
      return 3;
    case Outcome::not_run:
      return 4;
  }
  return 4;
}

/// Deterministic checks have no probability: among equals they count as the least telling when
/// they pass, and as the most telling when they fail.
double likelihood(const TestRecord& test) {
  if (test.log10_p) return *test.log10_p;
  return test.outcome == Outcome::reject ? -1e300 : 1.0;
}

bool worse(const TestRecord& a, const TestRecord& b) {
  return std::tuple(severity(a.outcome), likelihood(a)) <
         std::tuple(severity(b.outcome), likelihood(b));
}

}  // namespace

std::string sampler_and_density(const TestRecord& test) {
  return test.density_space.empty() ? test.sampler : test.sampler + " " + test.density_space;
}

std::vector<GateCell> summarise(const GateResult& gate) {
  std::vector<GateCell> cells;
  for (const TestRecord& test : gate.tests) {
    const std::string name = sampler_and_density(test);
    auto cell = std::find_if(cells.begin(), cells.end(), [&](const GateCell& c) {
      return c.sampler_and_density == name && c.map == test.map;
    });
    if (cell == cells.end()) {
      cell = cells.insert(cells.end(),
                          GateCell{name, test.sampler, test.map, test.known_defect, {}, &test});
    }
    cell->tally.add(test.outcome);
    if (worse(test, *cell->worst)) cell->worst = &test;
  }
  return cells;
}

bool is_known_defect(const GateResult& gate, const Rejection& rejection) {
  return std::any_of(gate.tests.begin(), gate.tests.end(), [&](const TestRecord& test) {
    return test.known_defect && test.sampler == rejection.sampler;
  });
}

SplitGate split_gate(const GateResult& gate, bool count_known_defects) {
  if (count_known_defects) return {gate, {}};
  SplitGate split{gate, gate};
  const auto is_known = [](const TestRecord& test) { return test.known_defect; };
  std::erase_if(split.deciding.tests, is_known);
  std::erase_if(split.known_defects.tests, std::not_fn(is_known));
  const auto is_known_rejection = [&](const Rejection& r) { return is_known_defect(gate, r); };
  std::erase_if(split.deciding.rejections, is_known_rejection);
  std::erase_if(split.known_defects.rejections, std::not_fn(is_known_rejection));
  return split;
}

std::vector<WorstBin> worst_bins(const Rejection& rejection, std::size_t most) {
  std::vector<WorstBin> bins;
  for (int y = 0; y < rejection.residual.extent().height; ++y) {
    for (int x = 0; x < rejection.residual.extent().width; ++x) {
      bins.push_back({x, y, rejection.residual(x, y)});
    }
  }
  std::stable_sort(bins.begin(), bins.end(), [](const WorstBin& a, const WorstBin& b) {
    return std::abs(a.residual) > std::abs(b.residual);
  });
  bins.resize(std::min(bins.size(), most));
  return bins;
}

std::string outcome_text(Outcome outcome) {
  switch (outcome) {
    case Outcome::accept:
      return "\u2713 accept";
    case Outcome::reject:
      return "\u2717 reject";
    case Outcome::inconclusive:
      return "? inconclusive";
    case Outcome::resolution_limited:
      return "\u2248 resolution-limited";
    case Outcome::not_run:
      return "- not run";
  }
  return "";
}

std::vector<LeftOutGroup> left_out_groups(const GateResult& gate) {
  std::vector<LeftOutGroup> groups;
  for (const LeftOut& each : gate.left_out) {
    auto group = std::find_if(groups.begin(), groups.end(), [&](const LeftOutGroup& other) {
      return other.map == each.map && other.reason == each.reason;
    });
    if (group == groups.end()) group = groups.insert(groups.end(), {each.map, each.reason, {}});
    group->samplers.push_back(fmt::format("{} {}", each.sampler, each.density_space));
  }
  return groups;
}

}  // namespace lightproof
