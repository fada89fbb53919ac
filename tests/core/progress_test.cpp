#include "lightproof/core/progress.h"

#include <gtest/gtest.h>

#include <string>

namespace lightproof {
namespace {

TEST(Progress, PartCoversItsShareOfTheWhole) {
  double seen = -1.0;
  std::string name;
  const Progress whole = [&](std::string_view step, double fraction) {
    name = step;
    seen = fraction;
  };
  const Progress part = part_of(whole, 0.25, 0.75);
  part("first", 0.0);
  EXPECT_EQ(seen, 0.25);
  part("second", 0.5);
  EXPECT_EQ(seen, 0.5);
  part_of(part, 0.5, 1.0)("third", 1.0);
  EXPECT_EQ(seen, 0.75);
  EXPECT_EQ(name, "third");
}

TEST(Progress, PartOfSilenceIsSilence) { EXPECT_FALSE(part_of(Progress(), 0.0, 1.0)); }

}  // namespace
}  // namespace lightproof
