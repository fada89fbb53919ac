#include "lightproof/core/executor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lightproof/core/moments.h"
#include "lightproof/core/random.h"

namespace lightproof {
namespace {

using testing::ElementsAre;

/// Moments of numbers that depend on the key alone, in an order of keys that is not that of cells.
std::vector<WorkCell<Moments>> moment_cells() {
  std::vector<WorkCell<Moments>> cells;
  for (const char* key : {"c", "a", "e", "b", "d"}) {
    cells.push_back({key, [key] {
                       Moments moments;
                       const RandomStream stream(key, 1);
                       for (std::uint64_t i = 0; i < 1000; ++i) moments.add(stream.point(i).s);
                       return moments;
                     }});
  }
  return cells;
}

Moments folded(const CellResults<Moments>& results) {
  Moments all;
  for (const auto& [key, moments] : results) all.merge(moments);
  return all;
}

std::string bits_of(const Moments& moments) {
  ValueWriter writer;
  writer.add(moments);
  return writer.take();
}

template <class Result>
std::vector<std::string> keys_of(const CellResults<Result>& results) {
  std::vector<std::string> keys;
  for (const auto& [key, result] : results) keys.push_back(key);
  return keys;
}

TEST(Executor, GivesTheSameBitsForAnyNumberOfThreads) {
  const std::vector<WorkCell<Moments>> cells = moment_cells();
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return bits_of(folded(compute_cells<Moments>(cells)));
  };
  EXPECT_EQ(with(2), with(1));
  EXPECT_EQ(with(7), with(1));
}

TEST(Executor, GivesTheSameBitsForAnyNumberOfShares) {
  const std::vector<WorkCell<Moments>> cells = moment_cells();
  const std::string whole = bits_of(folded(compute_cells<Moments>(cells)));
  for (const std::size_t of : {2U, 3U, 5U, 8U}) {
    CellResults<Moments> all;
    for (std::size_t index = of; index-- > 0;) {
      const std::string bytes = bytes_of(compute_cells<Moments>(cells, {index, of}));
      join(all, results_of<Moments>(bytes));
    }
    EXPECT_EQ(bits_of(folded(all)), whole) << of << " shares";
  }
}

TEST(Executor, DealsCellsOutByTheOrderOfTheirKeys) {
  const std::vector<WorkCell<Moments>> cells = moment_cells();
  EXPECT_THAT(keys_of(compute_cells<Moments>(cells)), ElementsAre("a", "b", "c", "d", "e"));
  EXPECT_THAT(keys_of(compute_cells<Moments>(cells, {0, 2})), ElementsAre("a", "b"));
  EXPECT_THAT(keys_of(compute_cells<Moments>(cells, {1, 2})), ElementsAre("c", "d", "e"));
}

TEST(Executor, RefusesAKeyThatIsThereTwice) {
  std::vector<WorkCell<Moments>> cells = moment_cells();
  CellResults<Moments> results = compute_cells<Moments>(cells, {0, 2});
  EXPECT_THROW(join(results, compute_cells<Moments>(cells, {0, 5})), std::logic_error);
  cells.push_back(cells.front());
  EXPECT_THROW(compute_cells<Moments>(cells), std::logic_error);
}

TEST(Executor, TellsHowFarItIs) {
  std::vector<double> seen;
  const Progress progress = [&](std::string_view step, double fraction) {
    EXPECT_EQ(step, "moments");
    seen.push_back(fraction);
  };
  compute_cells<Moments>(moment_cells(), {1, 2}, progress, "moments");
  EXPECT_THAT(seen, ElementsAre(1.0 / 3.0, 2.0 / 3.0, 1.0));
}

TEST(Executor, RefusesBytesThatAreCutOffOrTooMany) {
  const std::string bytes = bytes_of(compute_cells<Moments>(moment_cells()));
  for (const std::size_t length : {std::size_t{0}, std::size_t{9}, bytes.size() - 1}) {
    EXPECT_THROW(results_of<Moments>(bytes.substr(0, length)), std::out_of_range) << length;
  }
  EXPECT_THROW(results_of<Moments>(bytes + '\0'), std::logic_error);
}

TEST(Serialised, NumbersComeBackToTheLastBit) {
  const std::vector<double> numbers = {
      0.0, -0.0, 0.1, -1e308, std::numeric_limits<double>::denorm_min(), INFINITY, std::nan("")};
  ValueWriter writer;
  writer.add(numbers);
  writer.add(std::uint64_t{0xfedcba9876543210U});
  writer.add(std::string_view("a\0b", 3));
  const std::string bytes = writer.take();
  ValueReader reader(bytes);
  const std::vector<double> read = reader.value<std::vector<double>>();
  ASSERT_EQ(read.size(), numbers.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read[i]), std::bit_cast<std::uint64_t>(numbers[i]));
  }
  EXPECT_EQ(reader.number(), 0xfedcba9876543210U);
  EXPECT_EQ(reader.text(), std::string("a\0b", 3));
  EXPECT_TRUE(reader.is_at_end());
  EXPECT_EQ(bytes.substr(8 * 8, 2), "\x10\x32") << "little-endian";
}

}  // namespace
}  // namespace lightproof
