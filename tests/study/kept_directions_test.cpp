#include "lightproof/study/kept_directions.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "lightproof/core/temporary_folder.h"
#include "lightproof/gate/direction_sampler.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

TEST(KeptDirections, AreTakenUntilSamplesSeedOrProgramChange) {
  const TemporaryFolder folder;
  std::ofstream(folder / "program") << "machine code";
  const MeasurementCache cache = {folder / "cache", folder / "program", "0123456789abcdef"};
  const auto files = [&] {
    return std::distance(fs::directory_iterator(cache.folder), fs::directory_iterator());
  };
  GateOptions options = {.samples = 1024};
  const KeptMeasurement<ScreenedRuns> first = kept_directions(options, cache);
  EXPECT_EQ(first.value.size(), direction_samplers().size());
  EXPECT_FALSE(first.origin.empty());
  EXPECT_EQ(files(), 1);
  const auto written = fs::last_write_time(fs::directory_iterator(cache.folder)->path());
  const KeptMeasurement<ScreenedRuns> second = kept_directions(options, cache);
  EXPECT_EQ(second.origin, first.origin);
  EXPECT_EQ(bytes_of(second.value), bytes_of(first.value));
  EXPECT_EQ(fs::last_write_time(fs::directory_iterator(cache.folder)->path()), written);
  options.seed = 2;
  EXPECT_NE(bytes_of(kept_directions(options, cache).value), bytes_of(first.value));
  options.samples = 1025;
  kept_directions(options, cache);
  std::ofstream(folder / "program", std::ios::app) << '!';
  kept_directions(options, cache);
  EXPECT_EQ(files(), 4);
}

}  // namespace
}  // namespace lightproof
