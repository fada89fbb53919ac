// The matrix of methods and hard inputs: claims are kept, published forms fail as they are known
// to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/serialise.h"
#include "lightproof/stability/stability.h"

namespace lightproof {
namespace {

using testing::HasSubstr;

const StabilityResult& all() {
  static const StabilityResult result = run_stability(all_stability_methods(), {});
  return result;
}

std::string text_of(const StabilityRecord& record) {
  return std::to_string(record.number) + " " + record.kind + " " + record.method + ": " +
         to_string(record.outcome) + " by " + std::to_string(record.amount) + ", " + record.put_in +
         " -> " + record.came_out;
}

TEST(StabilityCases, AreThoseThatNeedNoDamagedFiles) {
  std::vector<int> numbers;
  std::set<std::string_view> names;
  for (const StabilityCase& row : stability_cases()) {
    numbers.push_back(row.number);
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_FALSE(row.input.empty() || row.required.empty() || row.source.empty()) << row.name;
  }
  std::vector<int> expected;
  for (int number = 1; number <= 38; ++number) expected.push_back(number);
  expected.insert(expected.end(), {41, 43});
  EXPECT_EQ(numbers, expected);
}

TEST(Stability, EveryClaimIsKept) {
  EXPECT_GT(all().records.size(), 1000U);
  for (const StabilityRecord& record : all().records) {
    EXPECT_FALSE(breaks_claim(record)) << text_of(record);
  }
}

TEST(Stability, MethodsThatCannotPassDoFail) {
  for (const StabilityRecord& record : all().records) {
    if (record.limit.empty()) continue;
    EXPECT_FALSE(passes(record)) << text_of(record);
  }
}

TEST(Stability, EveryRefusalSaysWhy) {
  for (const StabilityRecord& record : all().records) {
    if (record.outcome != StabilityOutcome::refused) continue;
    EXPECT_GT(record.came_out.size(), 10U) << text_of(record);
  }
}

StabilityOutcome outcome_of(int number, std::string_view method) {
  for (const StabilityRecord& record : all().records) {
    if (record.number == number && record.method == method) return record.outcome;
  }
  ADD_FAILURE() << "no record of case " << number << " and " << method;
  return StabilityOutcome::right;
}

TEST(Stability, ThePublishedScanFailsAsItIsKnownTo) {
  const std::string scan = "linear_scan_published/A";
  EXPECT_EQ(outcome_of(3, scan), StabilityOutcome::not_a_number);
  EXPECT_EQ(outcome_of(4, scan), StabilityOutcome::not_a_number);
  EXPECT_EQ(outcome_of(5, scan), StabilityOutcome::not_a_number);
  EXPECT_EQ(outcome_of(6, scan), StabilityOutcome::wrong);
  EXPECT_EQ(outcome_of(8, scan), StabilityOutcome::not_a_number);
  EXPECT_EQ(outcome_of(9, scan), StabilityOutcome::out_of_range);
  EXPECT_EQ(outcome_of(13, scan), StabilityOutcome::wrong);
  EXPECT_EQ(outcome_of(17, scan), StabilityOutcome::wrong);
}

TEST(Stability, ANearestDensityLosesSevenSixteenthsOfATexelLookedUpBilinearly) {
  for (const StabilityRecord& record : all().records) {
    if (record.number != 2 || record.method != "alias/A") continue;
    EXPECT_THAT(record.came_out, HasSubstr("43.75 %"));
  }
}

TEST(Stability, PublishedFormsBesideTheScanFailToo) {
  EXPECT_EQ(outcome_of(25, "karis, sum, published"), StabilityOutcome::not_a_number);
  EXPECT_EQ(outcome_of(26, "quaternion, published, float"), StabilityOutcome::wrong);
  EXPECT_EQ(outcome_of(26, "tangent frame, double"), StabilityOutcome::not_a_number);
  EXPECT_EQ(outcome_of(29, "R2 float"), StabilityOutcome::wrong);
  EXPECT_EQ(outcome_of(30, "hammersley float"), StabilityOutcome::out_of_range);
  EXPECT_EQ(outcome_of(31, "blended in float, published"), StabilityOutcome::wrong);
}

std::string bytes_of(const StabilityResult& result) {
  ValueWriter writer;
  writer.add(result);
  return writer.take();
}

TEST(Stability, IsTheSameForAnyNumberOfThreads) {
  const StabilityOptions options = {.trial = {.seed = 7},
                                    .methods = {"alias", "guide_lines", "fast", "ris 4", "R2"}};
  const StabilityMethods methods = all_stability_methods();
  std::string one;
  {
    const ThreadLimit limit(1);
    one = bytes_of(run_stability(methods, options));
  }
  EXPECT_EQ(bytes_of(run_stability(methods, options)), one);
}

TEST(Stability, RunsWhatWasAskedForAlone) {
  const StabilityResult some = run_stability(
      all_stability_methods(), {.cases = {"black-map", "8"}, .methods = {"alias/B", "phong"}});
  ASSERT_EQ(some.cases.size(), 2U);
  ASSERT_EQ(some.records.size(), 3U);
  EXPECT_EQ(some.records[0].method, "alias/B");
  EXPECT_EQ(some.records[1].method, "alias/B");
  EXPECT_EQ(some.records[2].method, "phong");
}

template <class Work>
std::string refusal_of(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Stability, RefusesNamesThatThereAreNot) {
  const StabilityMethods methods = all_stability_methods();
  EXPECT_THAT(refusal_of([&] { run_stability(methods, {.cases = {"white-map"}}); }),
              HasSubstr("no stability case is called 'white-map'; there are: one-bright-texel"));
  EXPECT_THAT(refusal_of([&] { run_stability(methods, {.methods = {"walker"}}); }),
              HasSubstr("no method is called 'walker'"));
}

}  // namespace
}  // namespace lightproof
