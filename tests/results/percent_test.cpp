// Shares as text.
#include "lightproof/results/percent.h"

#include <gtest/gtest.h>

namespace lightproof {
namespace {

TEST(PlainPercent, HasTwoDigitsAndNoExponent) {
  EXPECT_EQ(plain_percent(0.0123), "1.2 %");
  EXPECT_EQ(plain_percent(0.0996), "10 %");
  EXPECT_EQ(plain_percent(0.123), "12 %");
  EXPECT_EQ(plain_percent(2.5), "250 %");
  EXPECT_EQ(plain_percent(2e-5), "0.002 %");
  EXPECT_EQ(plain_percent(1e-6), "below 0.001 %");
}

}  // namespace
}  // namespace lightproof
