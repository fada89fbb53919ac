#include "lightproof/gate/judged_runs.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>

#include "lightproof/gate/diagnosis.h"

namespace lightproof {
namespace {

/// The runs of a test case that are rejected.
std::vector<RunIndex> rejected_in(const JudgedRuns& runs, std::size_t test_case) {
  std::vector<RunIndex> rejected;
  runs.records.for_each_of(test_case, [&](RunIndex at, const std::vector<TestRecord>& records) {
    if (is_any_rejected(records)) rejected.push_back(at);
  });
  return rejected;
}

/// The record of a call that was not answered; null if all were.
const TestRecord* unanswered_in(std::span<const TestRecord> records) {
  const auto found = std::ranges::find_if(records, [](const TestRecord& record) {
    return record.test == TestId::answers && record.outcome == Outcome::reject;
  });
  return found == records.end() ? nullptr : &*found;
}

/// What needs no diagnosis: the call says what happened, and there are no samples.
Rejection rejection_of(const TestRecord& unanswered) {
  return {unanswered.sampler,
          unanswered.density_space,
          unanswered.map,
          "no answer",
          unanswered.detail,
          Grid<double>(kGateBins),
          {}};
}

std::vector<Rejection> diagnose_together(const JudgedRuns& runs, std::vector<RunIndex> rejected,
                                         Expectations& expectations) {
  const std::size_t test_case = rejected.front().test_case;
  std::vector<Rejection> without_answer;
  std::erase_if(rejected, [&](RunIndex at) {
    const TestRecord* unanswered = unanswered_in(runs.records[at]);
    if (unanswered != nullptr) without_answer.push_back(rejection_of(*unanswered));
    return unanswered != nullptr;
  });
  if (rejected.empty()) return without_answer;
  return with_memory_for_gate(runs.test_cases[test_case], "", [&] {
    const std::shared_ptr<const Expectation> expectation = expectations.of(test_case);
    std::vector<DrawnRun> drawn;
    for (const RunIndex at : rejected) drawn.push_back(runs.drawn(at, *expectation));
    std::vector<Evidence> evidence;
    for (std::size_t i = 0; i < rejected.size(); ++i) {
      evidence.push_back({runs.records[rejected[i]], &drawn[i].draws, &drawn[i].inspection});
    }
    std::vector<Rejection> all = diagnose(runs.test_cases[test_case], *expectation, evidence);
    std::ranges::move(without_answer, std::back_inserter(all));
    return all;
  });
}

}  // namespace

bool is_any_rejected(std::span<const TestRecord> records) {
  return std::any_of(records.begin(), records.end(),
                     [](const TestRecord& record) { return record.outcome == Outcome::reject; });
}

void add_judged(GateResult& result, const JudgedRuns& runs, Expectations& expectations,
                const Communicator& communicator) {
  std::vector<WorkCell<std::vector<Rejection>>> cells;
  std::vector<std::string> keys;  // in the order of the test cases
  for (std::size_t i = 0; i < runs.test_cases.size(); ++i) {
    std::vector<RunIndex> rejected = rejected_in(runs, i);
    if (rejected.empty()) continue;
    keys.push_back(rejected.front().in(runs.test_cases, runs.seed).key("diagnosis"));
    cells.push_back({keys.back(),
                     [&runs, &expectations, rejected = std::move(rejected)] {
                       return diagnose_together(runs, rejected, expectations);
                     },
                     runs.test_cases[i].is_large()});
  }
  auto rejections = gather(
      compute_cells<std::vector<Rejection>>(cells, communicator.share, {}, {}, communicator.kept),
      communicator);
  for (const std::string& key : keys) {
    std::move(rejections.at(key).begin(), rejections.at(key).end(),
              std::back_inserter(result.rejections));
  }
  runs.records.for_each([&](RunIndex /*at*/, std::vector<TestRecord>& records) {
    std::move(records.begin(), records.end(), std::back_inserter(result.tests));
  });
}

}  // namespace lightproof
