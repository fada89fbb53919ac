#include "lightproof/core/json_text.h"

#include <gtest/gtest.h>

#include <string>

namespace lightproof {
namespace {

TEST(JsonDepth, CountsWhatLiesInsideOfEachOther) {
  EXPECT_EQ(json_depth(""), 0U);
  EXPECT_EQ(json_depth("17"), 0U);
  EXPECT_EQ(json_depth("{}"), 1U);
  EXPECT_EQ(json_depth(R"({"a": [1, [2]], "b": [3]})"), 3U);
  EXPECT_EQ(json_depth("[[], [], []]"), 2U);
}

TEST(JsonDepth, PassesOverText) {
  EXPECT_EQ(json_depth(R"({"[[[": "{{{"})"), 1U);
  EXPECT_EQ(json_depth(R"(["\"[[", [1]])"), 2U);
  EXPECT_EQ(json_depth(R"(["\\", [1]])"), 2U);
}

TEST(JsonDepth, IsSomeNumberOfWhatIsNoJson) {
  EXPECT_EQ(json_depth("]]]"), 0U);
  EXPECT_EQ(json_depth("\"[["), 0U);
  EXPECT_EQ(json_depth("\"\\"), 0U);
  EXPECT_EQ(json_depth(std::string(1'000'000, '[')), 1'000'000U);
}

}  // namespace
}  // namespace lightproof
