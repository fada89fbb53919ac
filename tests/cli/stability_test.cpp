// lightproof stability: what it prints, what it writes, what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"
#include "tests/cli/schema.h"

namespace lightproof::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(StabilityCommand, PrintsTheMatrixAndWhatFailed) {
  const Finished finished =
      lightproof({"stability", "--only", "zero-numbers", "--only", "9", "--method",
                  "linear_scan_published", "--method", "alias/B"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_THAT(finished.out, AllOf(HasSubstr("linear_scan_published/A  N  O"),
                                  HasSubstr("alias/B                  .  ."),
                                  HasSubstr("(as published)"), HasSubstr("2 of 2 claims kept")));
}

TEST(StabilityCommand, WritesJsonAndAPageOfItsOwn) {
  const TemporaryFolder folder;
  const Finished finished =
      lightproof({"stability", "--method", "linear_scan_published/A", "--method", "R2 float",
                  "--breaking-points", "-q", "--json", "s.json", "--html", "s.html"},
                 folder / "");
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_THAT(finished.out, IsEmpty());
  expect_valid("stability.schema.json", folder / "s.json");
  const json found = json_of(folder / "s.json");
  EXPECT_EQ(found.at("cases").size(), 40U);
  for (const json& record : found.at("records")) {
    EXPECT_TRUE(record.at("known_defects")) << record.dump();
    EXPECT_EQ(record.at("breaks_claim"), false);
  }
  EXPECT_EQ(found.at("breaking_points").size(), 6U);
  EXPECT_THAT(bytes_of(folder / "s.html"), HasSubstr("What do hard inputs do?"));
}

TEST(StabilityCommand, RefusesNamesThatThereAreNot) {
  const Finished cases = lightproof({"stability", "--only", "white-map"});
  EXPECT_EQ(cases.exit_code, 2);
  EXPECT_THAT(cases.err, HasSubstr("no stability case is called 'white-map'; there are:"));
  const Finished methods = lightproof({"stability", "--method", "walker"});
  EXPECT_EQ(methods.exit_code, 2);
  EXPECT_THAT(methods.err, HasSubstr("no method is called 'walker'; there are:"));
}

}  // namespace
}  // namespace lightproof::test
