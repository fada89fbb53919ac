#include "lightproof/image/map_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr Extent kExtent = {32, 16};

/// Maps that differ, in a store, and how often each was read again.
class StoredMaps {
 public:
  StoredMaps(std::size_t count, MapStore& store) : readings_(count) {
    for (std::size_t i = 0; i < count; ++i) {
      sources_.push_back(store.add(map_of(i), [this, i] {
        ++readings_[i];
        return map_of(i);
      }));
    }
  }
  StoredMaps(const StoredMaps&) = delete;
  StoredMaps& operator=(const StoredMaps&) = delete;

  static EnvironmentMap map_of(std::size_t i) {
    EnvironmentMap map = make_synthetic_map("constant", kExtent);
    map.name = "map " + std::to_string(i);
    map.radiance(0, 0) = Rgb(static_cast<float>(i + 2));
    return map;
  }
  std::shared_ptr<const EnvironmentMap> load(std::size_t i) const { return sources_[i].load(); }
  const MapSource& source(std::size_t i) const { return sources_[i]; }
  int readings(std::size_t i) const { return readings_[i]; }

 private:
  std::vector<int> readings_;
  std::vector<MapSource> sources_;
};

bool is_map(std::size_t i, const EnvironmentMap& map) {
  const EnvironmentMap expected = StoredMaps::map_of(i);
  return map.name == expected.name &&
         std::ranges::equal(map.radiance.values(), expected.radiance.values());
}

TEST(MapStore, KnowsOfAMapWhatNeedsNoTexels) {
  MapStore store;
  const StoredMaps maps(1, store);
  EXPECT_EQ(maps.source(0).name, "map 0");
  EXPECT_EQ(maps.source(0).extent, kExtent);
  EXPECT_EQ(maps.source(0).weights, kRec709);
}

TEST(MapStore, ReadsNothingAgainThatFits) {
  MapStore store(3 * kExtent.count());
  const StoredMaps maps(3, store);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(is_map(i, *maps.load(i)));
    EXPECT_EQ(maps.readings(i), 0);
  }
}

TEST(MapStore, KeepsThoseThatWereAskedForLast) {
  MapStore store(2 * kExtent.count());
  const StoredMaps maps(4, store);
  EXPECT_TRUE(is_map(0, *maps.load(0)));
  EXPECT_EQ(maps.readings(0), 1);
  maps.load(3);
  EXPECT_EQ(maps.readings(3), 0) << "only the one that was asked for before is let go of";
  maps.load(2);
  EXPECT_EQ(maps.readings(2), 1);
  maps.load(0);
  EXPECT_EQ(maps.readings(0), 2);
}

TEST(MapStore, HoldsNoMoreThanFits) {
  MapStore store(2 * kExtent.count());
  const StoredMaps maps(50, store);
  std::vector<std::weak_ptr<const EnvironmentMap>> given;
  for (std::size_t i = 0; i < 50; ++i) {
    given.emplace_back(maps.load(i));
    const auto alive = std::ranges::count_if(given, [](const auto& map) { return !map.expired(); });
    EXPECT_LE(alive, 2);
  }
}

TEST(MapStore, KeepsTheLastOneHoweverLarge) {
  MapStore store(1);
  const StoredMaps maps(2, store);
  maps.load(0);
  maps.load(0);
  EXPECT_EQ(maps.readings(0), 1);
}

TEST(MapStore, GivesEverybodyTheSameMapWhileAnybodyHoldsIt) {
  MapStore store(1);
  const StoredMaps maps(2, store);
  const auto held = maps.load(0);
  maps.load(1);
  EXPECT_EQ(maps.load(0), held);
  EXPECT_EQ(maps.readings(0), 1);
}

TEST(MapStore, ServesManyThreads) {
  MapStore store(2 * kExtent.count());
  const StoredMaps maps(16, store);
  std::vector<char> right(1024);
  parallel_for(right.size(), [&](std::size_t task) {
    right[task] = is_map(task % 16, *maps.load(task % 16)) ? 1 : 0;
  });
  EXPECT_EQ(std::ranges::count(right, 1), 1024);
}

TEST(MapStore, RefusesAFileThatHasChanged) {
  MapStore store(1);
  EnvironmentMap map = StoredMaps::map_of(0);
  map.source = "sky.exr";
  const MapSource source = store.add(map, [] { return StoredMaps::map_of(1); });
  EXPECT_NO_THROW(source.load()) << "it is still there";
  store.add(StoredMaps::map_of(2), [] { return StoredMaps::map_of(2); });
  EXPECT_THAT([&] { source.load(); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("sky.exr"), HasSubstr("has changed"))));
}

TEST(MapStore, PassesOnThatAFileIsGone) {
  MapStore store(1);
  const MapSource source = store.add(
      StoredMaps::map_of(0), []() -> EnvironmentMap { throw InputError("sky.exr: no such file"); });
  store.add(StoredMaps::map_of(2), [] { return StoredMaps::map_of(2); });
  EXPECT_THAT([&] { source.load(); }, ThrowsMessage<InputError>(HasSubstr("no such file")));
}

TEST(MapSources, OfMapsInMemoryGiveThese) {
  const EnvironmentMap map = StoredMaps::map_of(0);
  const std::vector<MapSource> sources = sources_of({&map, 1});
  ASSERT_EQ(sources.size(), 1U);
  EXPECT_EQ(sources[0].load().get(), &map);
}

}  // namespace
}  // namespace lightproof
