#include "lightproof/mutants/kill_matrix.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "lightproof/core/parallel.h"
#include "lightproof/mutants/direction_mutant.h"
#include "lightproof/mutants/mutant.h"
#include "lightproof/suite/sequential_gate.h"

namespace lightproof {
namespace {

constexpr std::uint64_t kFirst = std::uint64_t{1} << 12U;
constexpr std::uint64_t kUsual = std::uint64_t{1} << 18U;
constexpr std::uint64_t kMost = std::uint64_t{1} << 22U;

/// A mutant's problem, and what is expected of the gate.
struct Case {
  Problem problem;
  std::string_view oracle;
  std::string_view diagnosis;
};

std::vector<Case> cases_on(const EnvironmentMap& map) {
  std::vector<Case> cases;
  for (const Mutant& mutant : mutants()) {
    const Subject subject = subject_of(mutant, Weighting::B);
    cases.push_back({problems_of({&map, 1}, {&subject, 1})[0], mutant.oracle, mutant.diagnosis});
  }
  for (const DirectionMutant& mutant : direction_mutants()) {
    cases.push_back({problems_of({&mutant.sampler, 1})[0], mutant.oracle, mutant.diagnosis});
  }
  return cases;
}

bool is_killed(const KillRecord& record) {
  return std::any_of(record.kills.begin(), record.kills.end(), [&](const KillRecord::Kill& kill) {
    return kill.test.starts_with(record.oracle + "/");
  });
}

/// Adds the tests that reject for the first time.
void add_kills(KillRecord& record, const GateResult& result) {
  for (const TestRecord& test : result.tests) {
    if (test.outcome != Outcome::reject) continue;
    const std::string name = test.oracle + "/" + test.test;
    const bool known = std::any_of(record.kills.begin(), record.kills.end(),
                                   [&](const KillRecord::Kill& kill) { return kill.test == name; });
    // The second stage comes on top of the first.
    const std::uint64_t samples = test.samples + (test.stage == 2 ? result.samples : 0);
    if (!known) record.kills.push_back({name, samples});
  }
  if (!result.rejections.empty()) record.looks_like = result.rejections[0].looks_like;
}

KillRecord kill(Case& one, std::uint64_t seed) {
  one.problem = made_once(std::move(one.problem));
  KillRecord record{one.problem.candidates[0].name,
                    std::string(one.oracle),
                    "",
                    std::string(one.diagnosis),
                    {},
                    {}};
  for (std::uint64_t samples = kFirst; samples <= (is_killed(record) ? kUsual : kMost);
       samples *= 4) {
    add_kills(record, run_gate({&one.problem, 1}, {samples, seed}));
  }
  const GateResult sequential = run_sequential_gate({&one.problem, 1}, {kMost, seed});
  if (sequential.tests[0].outcome == Outcome::reject) {
    record.sequential = sequential.tests[0].samples;
  }
  return record;
}

}  // namespace

EnvironmentMap hostile_map() {
  constexpr Extent kExtent = {128, 64};
  EnvironmentMap map = {"hostile", Grid<Rgb>(kExtent), {}};
  for (int y = 1; y < kExtent.height; ++y) {
    for (int x = 0; x < kExtent.width; ++x) {
      const double around = 1.0 + 0.5 * std::sin(2.0 * kPi * x / kExtent.width + 1.0);
      const auto grey = static_cast<float>(3e-4 * (0.1 + 1.0 * y / kExtent.height) * around);
      const float warm = x < kExtent.width / 3 ? 1.6F : 1.0F;
      const bool sun = std::abs(x - 90) <= 1 && std::abs(y - 45) <= 1;
      map.radiance(x, y) = grey * (sun ? 40.0F : 1.0F) * Rgb(warm, 1.0F, 1.0F / warm);
    }
  }
  return map;
}

std::vector<KillRecord> measure_kills(std::uint64_t seed, const Progress& progress) {
  const EnvironmentMap map = hostile_map();
  std::vector<Case> cases = cases_on(map);
  std::vector<KillRecord> records(cases.size());
  std::mutex mutex;
  std::size_t done = 0;
  parallel_for(cases.size(), [&](std::size_t i) {
    records[i] = kill(cases[i], seed);
    const std::lock_guard lock(mutex);
    if (progress) {
      progress("self-test", static_cast<double>(++done) / static_cast<double>(cases.size()));
    }
  });
  return records;
}

}  // namespace lightproof
