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

// Bonferroni over cells bounds a p-value; of all others it is exact.
TEST(TestTable, CallsTheWorstCellsBounds) {
  for (const TestDescription& row : tests()) {
    EXPECT_EQ(row.p_value_is_bound, row.effect == EffectMeasure::worst_cell) << row.name;
  }
}

}  // namespace
}  // namespace lightproof
