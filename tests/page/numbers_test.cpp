#include "lightproof/page/numbers.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightproof {
namespace {

TEST(Numbers, KeepThreeSignificantDigits) {
  EXPECT_EQ(significant(0.0123456), "0.0123");
  EXPECT_EQ(significant(0.005), "0.00500");
  EXPECT_EQ(significant(1.23456), "1.23");
  EXPECT_EQ(significant(99.96), "100");
  EXPECT_EQ(significant(1234.5), "1234");
  EXPECT_EQ(significant(-0.5004), "-0.500");
  EXPECT_EQ(significant(3.14159, 5), "3.1416");
}

TEST(Numbers, UseShortExponentsAtTheEnds) {
  EXPECT_EQ(significant(1e-6), "1e-6");
  EXPECT_EQ(significant(1.234e-7), "1.23e-7");
  EXPECT_EQ(significant(2.5e12), "2.5e12");
}

TEST(Numbers, LeaveWholeNumbersWhole) {
  EXPECT_EQ(significant(0.0), "0");
  EXPECT_EQ(significant(7.0), "7");
  EXPECT_EQ(significant(1023.0, 6), "1023");
}

TEST(Numbers, NameWhatIsNotFinite) {
  EXPECT_EQ(significant(std::nan("")), "nan");
  EXPECT_EQ(significant(-HUGE_VAL), "-inf");
  EXPECT_EQ(format_number(HUGE_VAL), "\u221e");
  EXPECT_EQ(format_number(std::nan("")), "n/a");
}

TEST(Numbers, ShowTheDecimalsThatTheErrorAllows) {
  EXPECT_EQ(with_error(-0.49834, 0.0042), "\u22120.4983 \u00b1 0.0042");
  EXPECT_EQ(with_error(12.3456, 0.5), "12.35 \u00b1 0.50");
  EXPECT_EQ(with_error(1.5, 0.0), "1.50");
}

TEST(Numbers, ShowBytesInTheUnitThatFits) {
  EXPECT_EQ(bytes_text(0.0), "0\u00a0B");
  EXPECT_EQ(bytes_text(1023.0), "1023\u00a0B");
  EXPECT_EQ(bytes_text(49152.0), "48\u00a0KiB");
  EXPECT_EQ(bytes_text(1.5 * 1048576.0), "1.50\u00a0MiB");
  EXPECT_EQ(bytes_text(3.0 * 1024.0 * 1024.0 * 1048576.0), "3072\u00a0GiB");
}

TEST(Numbers, GroupThousands) {
  EXPECT_EQ(with_thousands(999), "999");
  EXPECT_EQ(with_thousands(4194304), "4,194,304");
  EXPECT_EQ(counted(1, "map"), "1 map");
  EXPECT_EQ(counted(1000, "map"), "1,000 maps");
  EXPECT_EQ(count_word(8), "eight");
  EXPECT_EQ(count_word(13), "13");
}

TEST(SecondsText, TakesTheUnitThatSuits) {
  EXPECT_EQ(seconds_text(9.5e-8), "95\u00a0ns");
  EXPECT_EQ(seconds_text(9.999e-7), "1.0\u00a0\u00b5s");
  EXPECT_EQ(seconds_text(1.34e-6), "1.3\u00a0\u00b5s");
  EXPECT_EQ(seconds_text(0.0042), "4.2\u00a0ms");
  EXPECT_EQ(seconds_text(2.0), "2\u00a0s");
}

TEST(PercentWithError, HasTheDecimalsOfTheError) {
  EXPECT_EQ(percent_with_error(0.0213, 0.0031), "2.13 \u00b1 0.31\u00a0%");
  EXPECT_EQ(percent_with_error(0.0213, 0.0), "2.1\u00a0%");
}

}  // namespace
}  // namespace lightproof
