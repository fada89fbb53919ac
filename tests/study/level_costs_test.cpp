// Costs of levels: errors against quadrature, times, and what is kept of them.
#include "lightproof/study/level_costs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "lightproof/core/serialise.h"
#include "lightproof/core/temporary_folder.h"
#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

constexpr LevelCostOptions kSmall = {
    .threads = 1, .level = {16, 8}, .texels = 16, .runs = 1, .gain_map = {32, 16}};

MapRecord map_called(const std::string& name) {
  MapRecord record;
  record.map = make_synthetic_map("gradient", {64, 32});
  record.map.name = name;
  return record;
}

std::string bytes_of(const LevelCosts& costs) {
  ValueWriter writer;
  writer.add(costs.levels);
  writer.add(costs.gains);
  return writer.take();
}

// Two levels that are exact to rounding to float are as far apart as the quadrature is off: 1e-5.
TEST(LevelCosts, AreNoErrorsOfExactMethodsAndErrorsOfTheOthers) {
  const MapRecord map = map_called("gradient");
  std::set<std::string> levels;
  for (const LevelCost& cost : measure_level_costs(map.map, kSmall)) {
    levels.insert(cost.level);
    const std::string name = cost.level + ", " + cost.method + ", " + cost.setting;
    const bool is_exact = cost.method == "fast" || cost.method == "closed form";
    if (is_exact) {
      EXPECT_LT(cost.error, 1e-5) << name;
    } else if (cost.setting == "64 samples") {
      EXPECT_GT(cost.error, 1e-5) << name;
      EXPECT_LT(cost.error, 0.5) << name;
    }
    EXPECT_LE(cost.error_low, cost.error) << name;
    EXPECT_GE(cost.error_high, cost.error) << name;
    EXPECT_GT(cost.milliseconds.median, 0.0) << name;
    EXPECT_EQ(cost.texels, 16U);
  }
  EXPECT_EQ(levels.size(), 2U);
}

TEST(LevelCosts, HaveEveryMethodThatPrecomputeHas) {
  const MapRecord map = map_called("gradient");
  std::set<std::string> methods;
  for (const LevelCost& cost : measure_level_costs(map.map, kSmall)) methods.insert(cost.method);
  EXPECT_EQ(methods,
            (std::set<std::string>{"Riemann sum", "closed form", "fast", "filtered", "half-vector",
                                   "lobe", "spherical-harmonics", "uniform"}));
}

TEST(LevelCosts, OfAThreadAreTimesOfOneAndTwo) {
  LevelCostOptions options = kSmall;
  options.runs = 3;
  const std::vector<ThreadGain> gains = measure_thread_gains(options);
  ASSERT_EQ(gains.size(), 3U);
  for (const ThreadGain& gain : gains) {
    for (const TimeRange& time : {gain.one, gain.two}) {
      EXPECT_GT(time.low, 0.0) << gain.work;
      EXPECT_LE(time.low, time.median) << gain.work;
      EXPECT_LE(time.median, time.high) << gain.work;
    }
    EXPECT_GT(gain.wall_over_processor, 0.0) << gain.work;
  }
}

TEST(LevelCosts, AreKeptOfTheSameProgramAndMap) {
  const TemporaryFolder folder;
  std::ofstream(folder / "program") << "machine code";
  MeasurementCache cache = {folder / "cache", folder / "program", "0123456789abcdef"};
  std::vector<MapRecord> maps = {map_called("one")};
  const auto files = [&] {
    return std::distance(fs::directory_iterator(folder / "cache"), fs::directory_iterator());
  };
  const LevelCosts measured = kept_level_costs(maps, kSmall, cache);
  EXPECT_EQ(files(), 2);
  const LevelCosts kept = kept_level_costs(maps, kSmall, cache);
  EXPECT_EQ(bytes_of(kept), bytes_of(measured)) << "times are never the same twice";
  EXPECT_EQ(kept.origin, measured.origin);
  cache.measure_again = true;
  EXPECT_NE(bytes_of(kept_level_costs(maps, kSmall, cache)), bytes_of(measured));
  cache.measure_again = false;
  maps.front().map.radiance(3, 4).x += 1.0F;
  kept_level_costs(maps, kSmall, cache);
  EXPECT_EQ(files(), 3) << "another map, the same gains of a thread";
  LevelCostOptions other = kSmall;
  other.threads = 2;
  kept_level_costs(maps, other, cache);
  EXPECT_EQ(files(), 5);
}

}  // namespace
}  // namespace lightproof
