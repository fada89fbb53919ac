#include "lightproof/self_test/kill_matrix.h"

#include <algorithm>
#include <cmath>

#include "lightproof/cases/adversarial_maps.h"
#include "lightproof/gate/sequential_gate.h"
#include "lightproof/self_test/direction_mutant.h"
#include "lightproof/self_test/mutant.h"

namespace lightproof {
namespace {

constexpr std::uint64_t kFirst = std::uint64_t{1} << 12U;

/// A mutant's test case, and what is expected of the gate.
struct Case {
  TestCase test_case;
  Oracle oracle;
  std::string_view diagnosis;
};

std::vector<Case> cases_on(const EnvironmentMap& map) {
  std::vector<Case> cases;
  for (const Mutant& mutant : mutants()) {
    const SamplerUnderTest under_test = sampler_under_test(mutant, DensitySpace::solid_angle);
    cases.push_back(
        {test_cases_of({&map, 1}, {&under_test, 1})[0], mutant.oracle, mutant.diagnosis});
  }
  for (const DirectionMutant& mutant : direction_mutants()) {
    cases.push_back({test_cases_of({&mutant.sampler, 1})[0], mutant.oracle, mutant.diagnosis});
  }
  return cases;
}

bool is_killed(const KillRecord& record) {
  return std::any_of(record.kills.begin(), record.kills.end(), [&](const KillRecord::Kill& kill) {
    return describe(kill.test).oracle == record.oracle;
  });
}

/// Adds the tests that reject for the first time.
void add_kills(KillRecord& record, const GateResult& result) {
  for (const TestRecord& test : result.tests) {
    if (test.outcome != Outcome::reject) continue;
    const bool known =
        std::any_of(record.kills.begin(), record.kills.end(),
                    [&](const KillRecord::Kill& kill) { return kill.test == test.test; });
    // The second stage comes on top of the first.
    const std::uint64_t samples = test.samples + (test.stage == 2 ? result.samples : 0);
    if (!known) record.kills.push_back({test.test, samples});
  }
  if (!result.rejections.empty()) record.looks_like = result.rejections[0].looks_like;
}

KillRecord kill(const Case& one, const KillOptions& options) {
  const TestCase test_case = made_once(one.test_case);
  KillRecord record{test_case.instances[0].name, one.oracle, "",
                    std::string(one.diagnosis),  {},         {}};
  for (std::uint64_t samples = kFirst;
       samples <= (is_killed(record) ? options.usual : options.most); samples *= 4) {
    add_kills(record, run_gate({&test_case, 1}, {samples, options.seed}));
  }
  const GateResult sequential = run_sequential_gate({&test_case, 1}, {options.most, options.seed});
  if (sequential.tests[0].outcome == Outcome::reject) {
    record.sequential = sequential.tests[0].samples;
  }
  return record;
}

}  // namespace

std::vector<KillRecord> measure_kills(const KillOptions& options, const Progress& progress,
                                      const Communicator& communicator) {
  if (options.most < kFirst) return {};
  const EnvironmentMap map = mutant_map();
  const std::vector<Case> cases = cases_on(map);
  const auto key_of = [](const Case& one) { return "kills/" + one.test_case.instances[0].name; };
  std::vector<WorkCell<KillRecord>> cells;
  for (const Case& one : cases) {
    cells.push_back({key_of(one), [&] { return kill(one, options); }});
  }
  CellResults<KillRecord> results = gather(
      compute_cells<KillRecord>(cells, communicator.share, progress, "self-test"), communicator);
  std::vector<KillRecord> records;
  for (const Case& one : cases) records.push_back(std::move(results.at(key_of(one))));
  return records;
}

}  // namespace lightproof
