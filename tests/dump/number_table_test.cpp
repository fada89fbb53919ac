#include "lightproof/dump/number_table.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "lightproof/core/error.h"
#include "tests/dump/files.h"

namespace lightproof {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class NumberTableFile : public testing::Test {
 protected:
  std::string write(std::string_view name, std::string_view bytes) {
    test::write_bytes(folder_ / name, bytes);
    return (folder_ / name).string();
  }
  static std::vector<double> all_of(const NumberTable& table) {
    std::vector<double> numbers(table.rows() * table.columns());
    table.read(0, numbers);
    return numbers;
  }
  /// What is said against opening a file.
  static std::string refusal(const std::string& file, std::size_t columns = 0) {
    try {
      NumberTable(file, std::nullopt, columns);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(NumberTableFile, OfNumPyHasTheNumbersOfBothPrecisions) {
  const std::vector<float> floats = {0.5F, -1.0F, 0.1F, 3.0F, 4.0F, 5.0F};
  const NumberTable single(
      write("a.npy", test::npy_header("<f4", "(2, 3)") + test::bytes_of(floats)), std::nullopt, 0);
  EXPECT_EQ(single.rows(), 2U);
  EXPECT_EQ(single.columns(), 3U);
  EXPECT_THAT(all_of(single), ElementsAre(0.5, -1.0, double{0.1F}, 3.0, 4.0, 5.0));
  EXPECT_EQ(single.rounding(), 0x1p-24);

  const std::vector<double> doubles = {0.1, 0.2, 0.3, 0.4};
  const NumberTable twice(
      write("b.npy", test::npy_header("<f8", "(2, 2)") + test::bytes_of(doubles)), std::nullopt, 0);
  EXPECT_THAT(all_of(twice), ElementsAre(0.1, 0.2, 0.3, 0.4));
  EXPECT_EQ(twice.rounding(), 0x1p-53);
}

TEST_F(NumberTableFile, IsReadFromAnyRowOn) {
  std::vector<float> floats;
  for (int i = 0; i < 12'000; ++i) floats.push_back(static_cast<float>(i));
  const NumberTable table(write("a.f32", test::bytes_of(floats)), std::nullopt, 4);
  EXPECT_EQ(table.rows(), 3'000U);
  std::vector<double> numbers(8);
  table.read(2'998, numbers);
  EXPECT_THAT(numbers, ElementsAre(11'992, 11'993, 11'994, 11'995, 11'996, 11'997, 11'998, 11'999));
}

TEST_F(NumberTableFile, OfTextTakesNamesSeparatorsAndComments) {
  const NumberTable table(write("a.csv",
                                "# drawn by a renderer\n\"x\", y;z\tpdf\n\n1,2,3,4\r\n"
                                "-1e-3 +.5 inf nan\n"),
                          std::nullopt, 0);
  EXPECT_THAT(table.names(), ElementsAre("x", "y", "z", "pdf"));
  ASSERT_EQ(table.rows(), 2U);
  const std::vector<double> numbers = all_of(table);
  EXPECT_THAT(std::vector<double>(numbers.begin(), numbers.begin() + 6),
              ElementsAre(1, 2, 3, 4, -1e-3, 0.5));
  EXPECT_TRUE(std::isinf(numbers[6]));
  EXPECT_TRUE(std::isnan(numbers[7]));
}

TEST_F(NumberTableFile, OfTextIsKnownByItsBytesWhereTheExtensionSaysNothing) {
  for (const char* name : {"a.dat", "a", "A.CSV", "a.Txt"}) {
    const NumberTable table(write(name, "x,y,z,pdf\r\n1,2,3,4\n5,6,7,8\n"), std::nullopt, 4);
    EXPECT_EQ(table.rows(), 2U) << name;
    EXPECT_THAT(all_of(table), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8)) << name;
  }
}

TEST_F(NumberTableFile, OfNumbersIsRawWhereTheExtensionSaysNothingOrThatItIs) {
  const std::vector<float> floats = {0.5F, -1.0F};
  const std::vector<double> doubles = {0.5, -1.0};
  EXPECT_THAT(all_of(NumberTable(write("a.dat", test::bytes_of(floats)), std::nullopt, 2)),
              ElementsAre(0.5, -1.0));
  EXPECT_THAT(all_of(NumberTable(write("a.F64", test::bytes_of(doubles)), std::nullopt, 2)),
              ElementsAre(0.5, -1.0));
  // Floats whose bytes are letters.
  EXPECT_EQ(NumberTable(write("a.f32", "ABCDEFGH"), std::nullopt, 2).rows(), 1U);
}

TEST_F(NumberTableFile, OfTextIsAsExactAsItsDecimals) {
  const NumberTable three(write("a.csv", "0.125,0.5\n"), std::nullopt, 0);
  EXPECT_DOUBLE_EQ(three.rounding(), 0.5e-3);
  const NumberTable nine(write("b.csv", "1.25e-7,0.5\n"), std::nullopt, 0);
  EXPECT_DOUBLE_EQ(nine.rounding(), 0.5e-9);
}

TEST_F(NumberTableFile, IsRefusedByTheRowWhereItIsCutOff) {
  const std::vector<float> five = {1, 2, 3, 4, 5};
  EXPECT_THAT(refusal(write("a.f32", test::bytes_of(five)), 2), HasSubstr("ends inside row 2"));
  EXPECT_THAT(refusal(write("b.npy", test::npy_header("<f4", "(3, 2)") + test::bytes_of(five))),
              HasSubstr("it ends in row 2"));
}

// numpy.save, called twice with one open file, writes one array behind the other.
TEST_F(NumberTableFile, OfNumPyIsRefusedForWhatLiesBehindTheAnnouncedRows) {
  const std::string array =
      test::npy_header("<f4", "(2, 2)") + test::bytes_of(std::vector<float>{1, 2, 3, 4});
  EXPECT_EQ(refusal(write("a.npy", array)), "accepted");
  EXPECT_THAT(refusal(write("b.npy", array + array)),
              HasSubstr("b.npy: 2 rows of 2 numbers are announced, and 144 bytes lie behind"));
  EXPECT_THAT(refusal(write("c.npy", array + '\0')), HasSubstr("1 bytes lie behind"));
}

TEST_F(NumberTableFile, IsRefusedByTheLineThatIsWrong) {
  EXPECT_THAT(refusal(write("a.csv", "1,2,3\n1,2\n")),
              HasSubstr("line 2 has 2 numbers, those before it 3"));
  EXPECT_THAT(refusal(write("b.csv", "1,2\n\n1,two\n")), HasSubstr("line 3: \"two\" is no number"));
  EXPECT_THAT(refusal(write("c.csv", "x,y,z\n1,2\n")), HasSubstr("line 2 has 2 numbers"));
}

TEST_F(NumberTableFile, IsRefusedForWhatItIsNot) {
  EXPECT_THAT(refusal(write("a.npy", test::npy_header("<i4", "(1, 1)") + "1234")),
              HasSubstr("NumPy's type <i4"));
  EXPECT_THAT(refusal(write("b.npy", test::npy_header("<f4", "(1, 1)", "True") + "1234")),
              HasSubstr("ascontiguousarray"));
  EXPECT_THAT(refusal(write("c.npy", test::npy_header("<f4", "(1, 1, 1)") + "1234")),
              HasSubstr("shape"));
  EXPECT_THAT(refusal(write("d.npy", "\x93NUMPY\x01")), HasSubstr("inside the header"));
  EXPECT_THAT(refusal(write("e.f32", "1234")), HasSubstr("--columns"));
  EXPECT_THAT(refusal(write("f.csv", "")), HasSubstr("is empty"));
  EXPECT_THAT(refusal(write("g.csv", "x,y,z\n")), HasSubstr("has no rows"));
  EXPECT_THAT(refusal(write("h.npy", test::npy_header("<f4", "(1, 4)") + "1234123412341234"), 3),
              HasSubstr("its rows have 4 numbers, --columns names 3"));
  EXPECT_THAT(refusal("/nowhere/samples.npy"), HasSubstr("No such file"));
  EXPECT_THAT(refusal("/"), HasSubstr("is a folder"));
}

// An exponent may be any number: what it says of decimals is bounded.
TEST_F(NumberTableFile, OfTextTakesExponentsOfAnySize) {
  const NumberTable table(
      write("a.csv", "1e-2147483648,1e2147483647,1e-99999999999999999999,0.25e+3\n"), std::nullopt,
      0);
  EXPECT_THAT(all_of(table), ElementsAre(0.0, kInfinity, 0.0, 250.0));
  EXPECT_EQ(table.rounding(), 0.5e-16);
}

TEST_F(NumberTableFile, OfTextHasWhatIsTooLargeForADoubleAsAnInfinity) {
  const NumberTable table(write("a.csv", "1e400,-1e400,+1e400,1e-400,-12.5e-400\n"), std::nullopt,
                          0);
  EXPECT_THAT(all_of(table), ElementsAre(kInfinity, -kInfinity, kInfinity, 0.0, 0.0));
}

TEST_F(NumberTableFile, OfTextWithoutANumberHasNoRows) {
  for (const char* text : {",", "\n", "# a note\n", "x,y,z\n", " \t\r\n;"}) {
    EXPECT_THAT(refusal(write("a.csv", text)), HasSubstr("has no rows")) << text;
    EXPECT_THAT(refusal(write("a.csv", text), 3), HasSubstr("has no rows")) << text;
  }
}

TEST_F(NumberTableFile, OfNumPyNamesAnyTypeInOneLine) {
  const std::string said =
      refusal(write("a.npy", test::npy_header("\n\x1b[2J" + std::string(1000, 'x'), "(1,)")));
  EXPECT_THAT(said, HasSubstr("NumPy's type \\x0a\\x1b[2Jxxx"));
  EXPECT_LT(said.size(), 400U);
}

}  // namespace
}  // namespace lightproof
