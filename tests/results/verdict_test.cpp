#include "lightproof/results/verdict.h"

#include <gtest/gtest.h>

namespace lightproof {
namespace {

GateResult result_of(std::initializer_list<Outcome> outcomes) {
  GateResult result;
  for (const Outcome outcome : outcomes) {
    TestRecord record;
    record.outcome = outcome;
    result.tests.push_back(record);
  }
  return result;
}

Outcome verdict(std::initializer_list<Outcome> outcomes) {
  return overall_outcome(result_of(outcomes), true);
}

TEST(Verdict, IsTheGravestOutcome) {
  using enum Outcome;
  EXPECT_EQ(verdict({accept, accept}), accept);
  EXPECT_EQ(verdict({accept, resolution_limited}), resolution_limited);
  EXPECT_EQ(verdict({inconclusive, resolution_limited, accept}), inconclusive);
  EXPECT_EQ(verdict({resolution_limited, inconclusive, reject, accept}), reject);
}

TEST(Verdict, OfNoTestsIsInconclusive) {
  EXPECT_EQ(verdict({}), Outcome::inconclusive);
  EXPECT_EQ(verdict({Outcome::not_run}), Outcome::inconclusive);
  EXPECT_EQ(verdict({Outcome::not_run, Outcome::accept}), Outcome::accept);
}

TEST(Verdict, CountsKnownDefectsOnlyWhereItIsToldTo) {
  GateResult result = result_of({Outcome::accept, Outcome::reject});
  result.tests[1].known_defect = true;
  EXPECT_EQ(overall_outcome(result, false), Outcome::accept);
  EXPECT_EQ(overall_outcome(result, true), Outcome::reject);
  EXPECT_EQ(deciding_tally(result).tests, 1U);
  EXPECT_EQ(known_defect_tally(result).rejected, 1U);
}

}  // namespace
}  // namespace lightproof
