#include "lightproof/dump/sample_columns.h"

#include <gmock/gmock.h>

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

using testing::HasSubstr;
using Names = std::vector<std::string>;

std::string refusal(const Names& names) {
  try {
    sample_columns(names);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SampleColumns, AreFoundByTheirNames) {
  const SampleColumns columns = sample_columns(Names{"-", "z", "pdf", "x", "y"});
  EXPECT_EQ(columns.count, 5U);
  EXPECT_EQ(columns.x, 3U);
  EXPECT_EQ(columns.y, 4U);
  EXPECT_EQ(columns.z, 1U);
  EXPECT_EQ(columns.pdf, 2U);
  EXPECT_TRUE(columns.are_directions());
}

TEST(SampleColumns, OfAnImageMayCountFromTheTop) {
  EXPECT_FALSE(sample_columns(Names{"s", "t"}).t_is_from_top);
  EXPECT_TRUE(sample_columns(Names{"u", "v"}).t_is_from_top);
}

TEST(SampleColumns, MayHoldAWeightInGreyOrInThreeChannels) {
  EXPECT_EQ(sample_columns(Names{"x", "y", "z", "weight"}).weight, 3U);
  const SampleColumns coloured = sample_columns(Names{"wb", "wg", "wr", "s", "t"});
  EXPECT_EQ(coloured.red, 2U);
  EXPECT_EQ(coloured.blue, 0U);
  EXPECT_THAT(refusal({"x", "y", "z", "wr", "wg"}), HasSubstr("three channels"));
  EXPECT_THAT(refusal({"x", "y", "z", "weight", "wr", "wg", "wb"}), HasSubstr("three channels"));
}

TEST(SampleColumns, AreRefusedIfTheyNameNoSample) {
  EXPECT_THAT(refusal({"x", "y"}), HasSubstr("x, y and z are needed"));
  EXPECT_THAT(refusal({"x", "y", "z", "s", "t"}), HasSubstr("x, y and z are needed"));
  EXPECT_THAT(refusal({"x", "y", "w"}), HasSubstr("no column is called \"w\""));
  EXPECT_THAT(refusal({"s", "t", "v"}), HasSubstr("two columns are v"));
  EXPECT_THROW(default_columns(2), InputError);
}

TEST(SampleColumns, WithoutNamesAreDirectionAndDensity) {
  EXPECT_EQ(default_columns(3), (Names{"x", "y", "z"}));
  EXPECT_EQ(default_columns(6), (Names{"x", "y", "z", "pdf", "-", "-"}));
}

}  // namespace
}  // namespace lightproof
