#include "lightproof/core/executor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>
#include <tuple>
#include <variant>

#include "lightproof/core/enumeration.h"
#include "lightproof/core/error.h"
#include "lightproof/core/grid.h"
#include "lightproof/core/moments.h"
#include "lightproof/core/random.h"
#include "tests/core/processes.h"

namespace lightproof {

enum class Colour { red, green };
template <>
inline constexpr std::size_t kValuesOf<Colour> = 2;

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

TEST(Executor, EveryCellFallsIntoOneShare) {
  for (const std::size_t count : {0U, 1U, 2U, 5U, 8U, 100U}) {
    for (const std::size_t of : {1U, 2U, 3U, 5U, 8U, 13U}) {
      for (std::size_t rank = 0; rank < count; ++rank) {
        std::size_t holders = 0;
        for (std::size_t index = 0; index < of; ++index) {
          holders += WorkShare{index, of}.holds(rank, count) ? 1 : 0;
        }
        EXPECT_EQ(holders, 1U) << "rank " << rank << " of " << count << ", shares: " << of;
      }
    }
  }
}

/// Two groups of squares; every preparation and computation is logged.
struct LoggedSquares {
  std::mutex mutex;
  std::vector<std::string> log;

  void write(const std::string& line) {
    const std::lock_guard lock(mutex);
    log.push_back(line);
  }
  std::vector<WorkGroup<double, double>> groups() {
    std::vector<WorkGroup<double, double>> all;
    for (const double base : {2.0, 3.0}) {
      const std::string name = base < 3.0 ? "a" : "b";
      WorkGroup<double, double> group{[this, base, name] {
                                        write("prepare " + name);
                                        return base;
                                      },
                                      {}};
      for (const char* cell : {"1", "2", "3"}) {
        group.cells.push_back({name + cell, [this, key = name + cell](double of) {
                                 write(key);
                                 return of * of;
                               }});
      }
      all.push_back(std::move(group));
    }
    return all;
  }
};

TEST(Executor, PreparesAGroupOnceAndOnlyWhereAnyOfItsCellsIsComputed) {
  LoggedSquares squares;
  const ThreadLimit limit(1);
  const auto results = compute_groups<double, double>(squares.groups(), {0, 2});
  EXPECT_THAT(squares.log, ElementsAre("prepare a", "a1", "a2", "a3"));
  EXPECT_THAT(results, ElementsAre(testing::Pair("a1", 4.0), testing::Pair("a2", 4.0),
                                   testing::Pair("a3", 4.0)));
  squares.log.clear();
  EXPECT_EQ((compute_groups<double, double>(squares.groups(), {1, 4}).size()), 2U);
  EXPECT_THAT(squares.log, ElementsAre("prepare a", "a2", "a3"));
  std::vector<WorkGroup<double, double>> twice = squares.groups();
  twice[1].cells[0].key = "a1";
  EXPECT_THROW((compute_groups<double, double>(twice)), std::logic_error);
}

TEST(Executor, GathersTheSameBitsAtEveryProcess) {
  const std::vector<WorkCell<Moments>> cells = moment_cells();
  const std::string whole = bytes_of(gather(compute_cells<Moments>(cells), Communicator()));
  for (const std::size_t of : {2U, 3U, 5U, 8U}) {
    const auto gathered = test::in_processes(of, [&](const Communicator& communicator) {
      return bytes_of(gather(compute_cells<Moments>(cells, communicator.share), communicator));
    });
    EXPECT_THAT(gathered, testing::Each(whole)) << of << " processes";
  }
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

/// Something of every kind.
struct Everything {
  bool flag = false;
  int negative = 0;
  Colour colour = Colour::red;
  std::string text;
  std::optional<double> none;
  std::optional<std::vector<std::uint64_t>> some;
  std::variant<double, std::string> chosen;
  Grid<float> grid;

  static auto fields(auto& all) {
    return std::tie(all.flag, all.negative, all.colour, all.text, all.none, all.some, all.chosen,
                    all.grid);
  }
};

const Everything& everything() {
  static const Everything all = [] {
    Everything made{true, -3, Colour::green, "word", {}, {{7, 8}}, "chosen", Grid<float>({3, 2})};
    made.grid(2, 1) = 0.5F;
    return made;
  }();
  return all;
}

template <class Value>
std::string bytes_of_value(const Value& value) {
  ValueWriter writer;
  writer.add(value);
  return writer.take();
}

TEST(Serialised, ValuesOfEveryKindComeBack) {
  const std::string bytes = bytes_of_value(everything());
  ValueReader reader(bytes);
  const Everything read = reader.value<Everything>();
  EXPECT_TRUE(reader.is_at_end());
  EXPECT_TRUE(read.flag);
  EXPECT_EQ(read.negative, -3);
  EXPECT_EQ(read.colour, Colour::green);
  EXPECT_EQ(read.text, "word");
  EXPECT_EQ(read.none, std::nullopt);
  EXPECT_THAT(*read.some, ElementsAre(7, 8));
  EXPECT_EQ(std::get<std::string>(read.chosen), "chosen");
  EXPECT_EQ(read.grid.extent(), (Extent{3, 2}));
  EXPECT_EQ(read.grid(2, 1), 0.5F);
}

TEST(Serialised, BytesThatAreCutOffAreRefusedWhereverTheyEnd) {
  const std::string bytes = bytes_of_value(everything());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    ValueReader reader(std::string_view(bytes).substr(0, length));
    EXPECT_THROW(reader.value<Everything>(), std::out_of_range) << length;
  }
}

template <class Value>
void expect_refused(std::uint64_t number) {
  const std::string bytes = bytes_of_value(number);
  ValueReader reader(bytes);
  EXPECT_THROW(reader.value<Value>(), std::out_of_range) << number;
}

TEST(Serialised, NumbersThatAreNoValueOfTheirTypeAreRefused) {
  expect_refused<bool>(2);
  expect_refused<int>(std::uint64_t{1} << 31U);
  expect_refused<Colour>(2);
  expect_refused<std::variant<double, std::string>>(2);
  for (const Extent extent : {Extent{-1, -1}, Extent{1 << 30, 1 << 30}}) {
    ValueWriter writer;
    writer.add(extent.width);
    writer.add(extent.height);
    writer.add(0.0);
    const std::string bytes = writer.take();
    ValueReader reader(bytes);
    EXPECT_THROW(reader.value<Grid<float>>(), std::out_of_range);
  }
}

/// How many of its holders there are at once.
class Holders {
 public:
  class Holder {
   public:
    explicit Holder(Holders& all) : all_(all) {
      const int now = ++all_.now_;
      int most = all_.most_;
      while (most < now && !all_.most_.compare_exchange_weak(most, now)) continue;
    }
    ~Holder() { --all_.now_; }
    Holder(const Holder&) = delete;
    Holder& operator=(const Holder&) = delete;

   private:
    Holders& all_;
  };
  int now() const { return now_; }
  int most() const { return most_; }

 private:
  std::atomic<int> now_ = 0;
  std::atomic<int> most_ = 0;
};

TEST(WorkGroups, WhoseCellsAreLargeHaveOneCellAtATimeAndNoOtherGroupBesides) {
  const ThreadLimit limit(4);
  Holders large;
  Holders all;
  std::atomic<int> inner = 0;
  std::vector<WorkGroup<int, int>> groups;
  for (int g = 0; g < 6; ++g) {
    WorkGroup<int, int> group;
    group.one_at_a_time = g % 2 == 0;
    group.prepare = [g] { return g; };
    for (int cell = 0; cell < 4; ++cell) {
      group.cells.push_back({"cell " + std::to_string(4 * g + cell), [&, cell](const int& shared) {
                               std::optional<Holders::Holder> one;
                               if (shared % 2 == 0) {
                                 one.emplace(large);
                                 EXPECT_EQ(all.now(), 0);
                               }
                               const Holders::Holder any(all);
                               parallel_for(8, [&](std::size_t) {
                                 std::this_thread::sleep_for(std::chrono::milliseconds(1));
                                 ++inner;
                               });
                               return 4 * shared + cell;
                             }});
    }
    groups.push_back(std::move(group));
  }
  const auto results = compute_groups<int, int>(groups);
  EXPECT_EQ(large.most(), 1);
  EXPECT_EQ(inner, 24 * 8);
  ASSERT_EQ(results.size(), 24U);
  for (const auto& [key, result] : results) EXPECT_EQ(key, "cell " + std::to_string(result));
}

TEST(WorkGroups, WhoseCellsAreLargeStopBetweenThem) {
  int computed = 0;
  WorkGroup<int, int> group{[] { return 0; }, {}, true};
  for (const char* key : {"a", "b", "c"}) {
    group.cells.push_back({key, [&](const int&) {
                             if (++computed == 2) request_interrupt();
                             return 0;
                           }});
  }
  EXPECT_THROW((compute_groups<int, int>({&group, 1})), Interrupted);
  EXPECT_EQ(computed, 2);
  withdraw_interrupt();
}

}  // namespace
}  // namespace lightproof
