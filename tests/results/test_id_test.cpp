#include "lightproof/results/test_id.h"

#include <gtest/gtest.h>

#include <set>

namespace lightproof {
namespace {

TEST(TestTable, DescribesEveryTestUnderItsOwnIdentifier) {
  for (const TestDescription& row : tests()) EXPECT_EQ(&describe(row.id), &row) << row.name;
}

TEST(TestTable, NamesNoTwoTestsAlike) {
  std::set<std::string> names;
  for (const TestDescription& row : tests()) names.insert(full_name(row.id));
  EXPECT_EQ(names.size(), tests().size());
  EXPECT_EQ(full_name(TestId::irradiance_z_variance), "variance/irradiance, normal +z");
}

TEST(TestTable, SaysWhatIsCountedAndWhatAnEffectMeans) {
  for (const TestDescription& row : tests()) {
    EXPECT_FALSE(row.counts.empty()) << row.name;
    EXPECT_FALSE(meaning_of(row.effect).empty()) << row.name;
    EXPECT_FALSE(to_string(row.oracle).empty()) << row.name;
  }
}

// Bonferroni over cells bounds a p-value, and so does evidence that is valid whatever the tails of
// what is averaged; of all others it is exact.
TEST(TestTable, CallsTheWorstCellsAndMeansWithAnyTailsBounds) {
  const std::set<TestId> with_any_tails = {TestId::given_area, TestId::given_light,
                                           TestId::given_weights, TestId::light_reached};
  for (const TestDescription& row : tests()) {
    EXPECT_EQ(row.p_value_is_bound,
              row.effect == EffectMeasure::worst_cell || with_any_tails.contains(row.id))
        << row.name;
  }
}

}  // namespace
}  // namespace lightproof
