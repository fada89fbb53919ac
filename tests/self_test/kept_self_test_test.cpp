// What is kept is what was measured, and anything that it depends on makes it measured anew. A kept
// result is told from a new one by an origin that no measurement has.
#include "lightproof/self_test/kept_self_test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "lightproof/core/kept_file.h"
#include "lightproof/core/temporary_folder.h"
#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// As little as there is to measure.
SelfTestOptions small_options() {
  SelfTestOptions options = self_test_options(1);
  options.calibration.replicates = 20;
  options.calibration.samples = options.calibration.run_samples = 256;
  options.calibration.runs = 2;
  options.power.replicates = 2;
  options.kills.most = 0;
  options.naming.seeds = 1;
  options.naming.samples = 1024;
  return options;
}

MapRecord map_called(const std::string& name, float scale = 1.0F) {
  MapRecord record;
  record.map = make_synthetic_map("gradient", {8, 4});
  record.map.name = name;
  for (Rgb& rgb : record.map.radiance.values()) rgb *= scale;
  return record;
}

/// All numbers, without the origins.
std::string bytes_of(SelfTestResult result) {
  result.origin.clear();
  result.naming_origin.clear();
  ValueWriter writer;
  writer.add(result);
  return writer.take();
}

std::vector<fs::path> files_in(const fs::path& folder, std::string_view kind) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with(kind)) files.push_back(entry.path());
  }
  return files;
}

/// A study's self-test, run once and kept.
class KeptSelfTest : public testing::Test {
 protected:
  KeptSelfTest() { std::ofstream(folder_ / "program") << "machine code"; }

  SelfTestResult get() { return kept_self_test(maps_, options_, cache_); }
  std::size_t kept(std::string_view kind) { return files_in(cache_.folder, kind).size(); }

  TemporaryFolder folder_;
  std::vector<MapRecord> maps_ = {map_called("one")};
  SelfTestOptions options_ = small_options();
  MeasurementCache cache_ = {folder_ / "cache", folder_ / "program", "0123456789abcdef"};
};

TEST_F(KeptSelfTest, GivesTheNumbersThatWereMeasured) {
  const std::string measured = bytes_of(run_self_test(maps_, options_));
  const SelfTestResult first = get();
  EXPECT_EQ(bytes_of(first), measured);
  EXPECT_THAT(first.origin, testing::AllOf(HasSubstr("+00:00, "), HasSubstr("cores, "),
                                           HasSubstr(", commit 0123456789ab")));
  EXPECT_EQ(kept("self-test"), 1U);
  EXPECT_EQ(kept("naming"), 1U);
  const auto written = fs::last_write_time(files_in(cache_.folder, "self-test")[0]);
  const SelfTestResult second = get();
  EXPECT_EQ(bytes_of(second), measured);
  EXPECT_EQ(second.origin, first.origin);
  EXPECT_EQ(second.naming_origin, first.naming_origin);
  EXPECT_EQ(fs::last_write_time(files_in(cache_.folder, "self-test")[0]), written);
}

TEST_F(KeptSelfTest, IsMeasuredAnewForWhateverItDependsOn) {
  get();
  std::size_t files = 1;
  const std::vector<std::function<void()>> changes = {
      [&] { std::ofstream(folder_ / "program", std::ios::app) << '!'; },
      [&] { cache_.commit = "fedcba9876543210"; },
      [&] { options_.calibration.seed = 2; },
      [&] { options_.calibration.samples = 257; },
      [&] { options_.power.replicates = 3; },
      [&] { options_.kills.seed = 2; },
      [&] { options_.naming.samples = 1025; },
  };
  for (const auto& change : changes) {
    change();
    get();
    EXPECT_EQ(kept("self-test"), ++files);
    EXPECT_EQ(kept("naming"), files);
  }
}

TEST_F(KeptSelfTest, NamesMutantsAnewOnOtherMapsAlone) {
  get();
  maps_ = {map_called("one"), map_called("two"), map_called("one", 2.0F)};
  maps_[2].map.name = "one";
  const std::string measured = bytes_of(run_self_test(maps_, options_));
  EXPECT_EQ(bytes_of(get()), measured) << "kept and new ones are added up";
  EXPECT_EQ(kept("self-test"), 1U);
  EXPECT_EQ(kept("naming"), 3U);
}

TEST_F(KeptSelfTest, IsMeasuredAgainWhereTheCacheIsDamagedOrForeign) {
  const std::string measured = bytes_of(get());
  for (const std::string_view kind : {"self-test", "naming"}) {
    const fs::path file = files_in(cache_.folder, kind)[0];
    const auto size = fs::file_size(file);
    for (const std::string_view content : {std::string_view(), std::string_view("{}")}) {
      std::ofstream(file) << content;
      EXPECT_EQ(bytes_of(get()), measured);
      EXPECT_EQ(fs::file_size(file), size) << "replaced";
    }
    fs::resize_file(file, size - 1);
    EXPECT_EQ(bytes_of(get()), measured);
  }
}

TEST_F(KeptSelfTest, IsMeasuredAgainOnRequest) {
  get();
  const std::vector<fs::path> files = files_in(cache_.folder, "");
  const auto long_ago = fs::last_write_time(files[0]) - std::chrono::hours(24);
  for (const fs::path& file : files) fs::last_write_time(file, long_ago);
  cache_.measure_again = true;
  get();
  for (const fs::path& file : files) EXPECT_GT(fs::last_write_time(file), long_ago) << file;
  EXPECT_EQ(files_in(cache_.folder, "").size(), files.size());
}

TEST_F(KeptSelfTest, NeedsNeitherCacheNorAProgramThatCanBeRead) {
  const std::string measured = bytes_of(get());
  cache_.program = folder_ / "none";
  EXPECT_EQ(bytes_of(get()), measured);
  EXPECT_EQ(kept("self-test"), 1U) << "of a program that is not known nothing is kept";
  cache_.folder = "";
  EXPECT_EQ(bytes_of(get()), measured);
}

}  // namespace
}  // namespace lightproof
