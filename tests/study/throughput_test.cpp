#include "lightproof/study/throughput.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "lightproof/core/error.h"
#include "lightproof/core/random.h"
#include "lightproof/core/serialise.h"
#include "lightproof/core/temporary_folder.h"

namespace lightproof {
namespace {

class ThroughputFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }
  void write(std::string_view text) { std::ofstream(file_) << text; }

  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() /
      ("lightproof-throughput-" +
       std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".json");
};

std::string run(std::string_view name, double ns) {
  return "{\"name\":\"" + std::string(name) + "\",\"run_name\":\"" + std::string(name) +
         "\",\"run_type\":\"iteration\",\"ns_per_sample\":" + std::to_string(ns) +
         ",\"table_bytes\":100,\"build_ms\":2.5}";
}

TEST_F(ThroughputFile, MedianAndRangeOfRepetitions) {
  const std::string name = "sample/binary_search/sun-sky/512x256/random";
  write("{\"benchmarks\":[" + run(name, 30) + "," + run(name, 50) + "," + run(name, 35) + "]}");
  const auto records = read_throughput(file_).samplers;
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records[0].sampler, "binary_search");
  EXPECT_EQ(records[0].map, "sun-sky");
  EXPECT_EQ(records[0].extent, (Extent{512, 256}));
  EXPECT_EQ(records[0].ns_per_sample, 35.0);
  EXPECT_EQ(records[0].ns_low, 30.0);
  EXPECT_EQ(records[0].ns_high, 50.0);
  EXPECT_EQ(records[0].table_bytes, 100.0);
  EXPECT_EQ(records[0].build_ms, 2.5);
}

TEST_F(ThroughputFile, TablesAreTheFusedRowsThatKnowTheirError) {
  const std::string counters =
      ",\"bytes_per_texel\":8,\"worst_texel_error\":0.25,\"times_baseline\":30,"
      "\"share_of_limit\":0.5}";
  std::string fused = run("sample/alias/sun-sky/512x256/fused", 4);
  fused.replace(fused.size() - 1, 1, counters);
  write("{\"benchmarks\":[" + run("sample/a/b/4x2/random", 9) + "," + fused + "," +
        run("sample/bare_gather_2B/sun-sky/512x256/fused", 2) + "]}");
  const auto tables = read_throughput(file_).tables;
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_EQ(tables[0].sampler, "alias");
  EXPECT_EQ(tables[0].extent, (Extent{512, 256}));
  EXPECT_EQ(tables[0].ns_per_sample, 4.0);
  EXPECT_EQ(tables[0].bytes_per_texel, 8.0);
  EXPECT_EQ(tables[0].worst_texel_error, 0.25);
  EXPECT_EQ(tables[0].times_baseline, 30.0);
  EXPECT_EQ(tables[0].share_of_limit, 0.5);
}

TEST_F(ThroughputFile, DirectionsHaveTheirDensityAndTheirRatios) {
  std::string fused = run("directions/alias/sun-sky/2048x1024/C/fused", 5);
  fused.replace(fused.size() - 1, 1, ",\"times_baseline\":40,\"share_of_limit\":0.7}");
  write("{\"benchmarks\":[" + run("sample/a/b/4x2/random", 9) + "," + fused + "," +
        run("directions/upper_bound_baseline/sun-sky/2048x1024/C/fused", 200) + "]}");
  const auto directions = read_throughput(file_).directions;
  ASSERT_EQ(directions.size(), 2U);
  EXPECT_EQ(directions[0].sampler, "alias");
  EXPECT_EQ(directions[0].extent, (Extent{2048, 1024}));
  EXPECT_EQ(directions[0].density, "C");
  EXPECT_EQ(directions[0].order, DrawOrder::fused);
  EXPECT_EQ(directions[0].ns_per_sample, 5.0);
  EXPECT_EQ(directions[0].times_baseline, 40.0);
  EXPECT_EQ(directions[0].share_of_limit, 0.7);
  EXPECT_EQ(directions[1].times_baseline, 0.0);
}

TEST_F(ThroughputFile, SaysThatTheMachineWasBusyFromATenthMoreWallTimeOn) {
  const auto origin_at = [&](const char* real_time) {
    std::string row = run("sample/a/b/4x2/random", 9);
    row.replace(row.size() - 1, 1,
                std::string(",\"cpu_time\":100,\"real_time\":") + real_time + "}");
    write("{\"context\":{\"date\":\"today\"},\"benchmarks\":[" + row + "]}");
    return read_throughput(file_).origin;
  };
  EXPECT_EQ(origin_at("109"), "today");
  EXPECT_EQ(origin_at("210"),
            "today; the machine was busy during 1 of 1 benchmarks: their wall time exceeds their "
            "processor time by more than a tenth, and is up to 2.1 times it");
}

TEST_F(ThroughputFile, EveryRowSaysWhetherItMetABusyMachine) {
  const auto timed = [](std::string_view name, std::string_view real_time) {
    std::string row = run(name, 9);
    row.replace(row.size() - 1, 1,
                ",\"cpu_time\":100,\"real_time\":" + std::string(real_time) + "}");
    return row;
  };
  write("{\"benchmarks\":[" + timed("sample/a/b/4x2/random", "101") + "," +
        timed("sample/b/b/4x2/random", "130") + "," + timed("directions/a/b/4x2/B/ahead", "250") +
        "," + timed("directions/a/b/4x2/B/positions", "300") + "]}");
  const Throughput read = read_throughput(file_);
  ASSERT_EQ(read.samplers.size(), 2U);
  EXPECT_EQ(read.samplers[0].wall_per_cpu, 1.01);
  EXPECT_EQ(read.samplers[1].wall_per_cpu, 1.3);
  ASSERT_EQ(read.directions.size(), 1U);  // positions are no directions
  EXPECT_EQ(read.directions[0].order, DrawOrder::ahead);
  EXPECT_EQ(read.directions[0].wall_per_cpu, 2.5);
  EXPECT_EQ(read.busy_rows, 3U);
  EXPECT_EQ(read.wall_per_cpu, 3.0);
}

TEST_F(ThroughputFile, OtherBenchmarksAndAggregatesAreLeftOut) {
  write("{\"benchmarks\":[" + run("render/uniform/lambert/64x32/plane", 9) + "," +
        run("sample/a/b/4x2/random", 9) +
        ",{\"run_name\":\"sample/a/b/2x1/random\",\"run_type\":\"aggregate\"}]}");
  const auto records = read_throughput(file_).samplers;
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records[0].extent, (Extent{4, 2}));
}

TEST_F(ThroughputFile, ABenchmarkThatFailedIsNotLeftOutSilently) {
  write("{\"benchmarks\":[" + run("sample/a/b/4x2/random", 9) +
        ",{\"run_name\":\"sample/wrong/b/4x2/random\",\"run_type\":\"iteration\","
        "\"error_occurred\":true,\"error_message\":\"texel (1, 2)\"}]}");
  try {
    read_throughput(file_);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("sample/wrong/b/4x2/random"));
    EXPECT_THAT(error.what(), testing::HasSubstr("texel (1, 2)"));
  }
}

TEST_F(ThroughputFile, WhatIsNotGoogleBenchmarksIsRefusedByName) {
  const std::string deep = R"({"benchmarks":[], "context": )" + std::string(1'000'000, '[') +
                           std::string(1'000'000, ']') + "}";
  const std::string huge = "{\"benchmarks\":[" + run("sample/a/b/99999999999x1/random", 9) + "]}";
  for (const std::string_view text :
       {std::string_view(""), std::string_view("not json"), std::string_view("[]"),
        std::string_view("{\"benchmarks\":[]}"),
        std::string_view("{\"benchmarks\":[{\"run_type\":3}]}"), std::string_view(huge),
        std::string_view(deep)}) {
    write(text);
    try {
      read_throughput(file_);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(file_.string()), std::string::npos);
    }
  }
  EXPECT_THROW(read_throughput("/no/such/file.json"), InputError);
  EXPECT_THROW(read_throughput("/"), InputError);
}

TEST(MeasureThroughput, AProgramThatCannotRunIsNamed) {
  EXPECT_THROW(measure_throughput({"/no/such/program", 512}), InputError);
  EXPECT_THROW(measure_throughput({"/bin/false", 512}), InputError);
}

TEST(ThroughputFilter, ChoosesSingleSamplesUpToAWidthAndTheTablesOfOneSize) {
  const std::string filter = throughput_filter(1024);
  for (const char* name :
       {"sample/alias/sun-sky/256x128/random", "sample/alias/sun-sky/384x192/random",
        "sample/alias/sun-sky/768x384/random", "sample/alias/sun-sky/1024x512/random",
        "sample/alias/sun-sky/2048x1024/fused", "sample/bare_gather_2B/sun-sky/2048x1024/fused",
        "directions/alias/sun-sky/2048x1024/C/scalar", "directions/alias/sun-sky/2048x1024/B/ahead",
        "directions/bare_gather_2B/sun-sky/2048x1024/A/fused"}) {
    EXPECT_THAT(name, testing::MatchesRegex(filter));
  }
  for (const char* name :
       {"sample/alias/sun-sky/1536x768/random", "sample/alias/sun-sky/2048x1024/random",
        "sample/alias/sun-sky/1024x512/fused", "sample/alias/sun-sky/1024x512/batch",
        "directions/linear_scan/sun-sky/2048x1024/C/scalar",
        "directions/alias/sun-sky/8192x4096/C/scalar", "build/alias/sun-sky/256x128/random",
        "sample/alias/sun-sky/2560x128/random"}) {
    EXPECT_THAT(name, testing::Not(testing::MatchesRegex(filter)));
  }
  EXPECT_THAT("directions/alias/sun-sky/8192x4096/C/scalar",
              testing::MatchesRegex(throughput_filter(8192)));
  EXPECT_THAT("sample/alias/sun-sky/16384x8192/random",
              testing::MatchesRegex(throughput_filter(16384)));
}

TEST_F(ThroughputFile, NamesOfOtherShapesAreLeftOut) {
  std::string runs = run("sample/a/b/4x2/random", 9);
  for (const char* name : {"sample/a/b/4x2/random/extra", "sample/a/b/4x2", "sample/a/b/4/random",
                           "sample/a/b/4x2x1/random", "sample/a/b/x2/random",
                           "sample/a/b/-4x2/random", "sample/a/b/4x2/batch"}) {
    runs += ',';
    runs += run(name, 1);
  }
  write("{\"benchmarks\":[" + runs + "]}");
  EXPECT_EQ(read_throughput(file_).samplers.size(), 1U);
}

TEST_F(ThroughputFile, CachesAreThoseOfTheMachineThatMeasured) {
  const std::string benchmarks = "\"benchmarks\":[" + run("sample/a/b/4x2/random", 9) + "]}";
  write(
      "{\"context\":{\"caches\":[{\"type\":\"Data\",\"level\":1,\"size\":49152},"
      "{\"type\":\"Instruction\",\"level\":2,\"size\":5},"
      "{\"type\":\"Unified\",\"level\":2,\"size\":1048576}]}," +
      benchmarks);
  const CacheSizes caches = read_throughput(file_).caches;
  EXPECT_EQ(caches.l2, 1048576.0);
  EXPECT_EQ(caches.l3, std::nullopt);
  write('{' + benchmarks);
  EXPECT_EQ(read_throughput(file_).caches.l2, std::nullopt);
}

ThroughputSource small_source(const TemporaryFolder& folder) {
  return {LIGHTPROOF_SMALL_BENCHMARK, 256, folder / "cache"};
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  return {std::filesystem::directory_iterator(folder), {}};
}

/// Puts another measurement in the place of what is kept in a file.
void replace_kept(const std::filesystem::path& file, const std::string& content) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  ValueReader reader(bytes);
  ValueWriter writer;
  writer.add(reader.text());  // what kind of file it is
  writer.add(reader.text());  // of what the measurement is
  writer.add(hash_text(content));
  writer.add(content);
  std::ofstream(file, std::ios::binary) << writer.take();
}

// What is kept is told from what is measured by a mark that no benchmark makes.
TEST(MeasuredThroughput, IsKeptAndTakenFromTheCache) {
  const TemporaryFolder folder;
  ThroughputSource source = small_source(folder);
  const Throughput first = measure_throughput(source);
  EXPECT_FALSE(first.origin.empty());
  ASSERT_EQ(files_in(source.cache).size(), 1U);
  const std::filesystem::path kept = files_in(source.cache)[0];
  replace_kept(kept, R"({"context": {"date": "once"}, "benchmarks": [{"run_name":
      "sample/own/constant/256x128/random", "run_type": "iteration", "ns_per_sample": 7.0,
      "table_bytes": 1.0, "build_ms": 1.0}]})");
  const Throughput second = measure_throughput(source);
  EXPECT_EQ(second.origin, "once");
  EXPECT_EQ(second.samplers[0].ns_per_sample, 7.0);
  source.measure_again = true;
  EXPECT_EQ(measure_throughput(source).samplers[0].ns_per_sample, 2.0);
  EXPECT_EQ(files_in(source.cache), std::vector{kept}) << "replaced";
}

TEST(MeasuredThroughput, OfABusyMachineIsMeasuredAgain) {
  const TemporaryFolder folder;
  const ThroughputSource source = small_source(folder);
  measure_throughput(source);
  const std::filesystem::path kept = files_in(source.cache)[0];
  std::string rows;
  // Two rows: as many as that cannot be busy in what the small program measures.
  for (const char* map : {"constant", "sun"}) {
    rows += std::string(rows.empty() ? "" : ",") + R"({"run_name": "sample/own/)" + map +
            R"(/256x128/random", "run_type": "iteration", "ns_per_sample": 7.0,
            "table_bytes": 1.0, "build_ms": 1.0, "cpu_time": 1.0, "real_time": 1.2})";
  }
  replace_kept(kept, R"({"context": {"date": "once"}, "benchmarks": [)" + rows + "]}");
  EXPECT_EQ(measure_throughput(source).samplers[0].ns_per_sample, 2.0);
}

TEST(MeasuredThroughput, IsMeasuredAgainWhereTheCacheIsDamaged) {
  const TemporaryFolder folder;
  const ThroughputSource source = small_source(folder);
  measure_throughput(source);
  const std::filesystem::path kept = files_in(source.cache)[0];
  std::ofstream(kept) << "{";
  EXPECT_EQ(measure_throughput(source).samplers[0].ns_per_sample, 2.0);
  EXPECT_GT(std::filesystem::file_size(kept), 100U);
}

TEST(MeasuredThroughput, OfAnotherProgramOrOtherSizesIsAnother) {
  const TemporaryFolder folder;
  ThroughputSource source = small_source(folder);
  measure_throughput(source);
  source.largest_width = 512;
  measure_throughput(source);
  EXPECT_EQ(files_in(source.cache).size(), 2U);
  std::filesystem::copy_file(source.program, folder / "other");
  std::ofstream(folder / "other", std::ios::app) << "one byte more";
  source.program = folder / "other";
  measure_throughput(source);
  EXPECT_EQ(files_in(source.cache).size(), 3U);
}

TEST(MeasuredThroughput, HasThePluginsOrSaysWhyOneIsNotTimed) {
  const TemporaryFolder folder;
  ThroughputSource source = small_source(folder);
  source.plugins = {"wrong.so", "mine.so"};
  for (int run = 0; run < 2; ++run) {  // the second time the rest is kept
    const Throughput measured = measure_throughput(source);
    EXPECT_EQ(measured.samplers.size(), 1U);
    ASSERT_EQ(measured.directions.size(), 1U);
    EXPECT_EQ(measured.directions[0].sampler, "mine");
    EXPECT_EQ(measured.directions[0].order, DrawOrder::batch);
    EXPECT_EQ(measured.directions[0].ns_per_sample, 3.0);
    EXPECT_EQ(measured.directions[0].wall_per_cpu, 1.0) << "of its own process";
    EXPECT_THAT(measured.origin, testing::HasSubstr("plug-in wrong.so is not timed"));
    EXPECT_THAT(measured.origin, testing::HasSubstr("the first sample is elsewhere"));
    EXPECT_THAT(measured.origin, testing::Not(testing::HasSubstr("mine.so")));
  }
}

TEST(MeasuredThroughput, NeedsNoCache) {
  ThroughputSource source = {LIGHTPROOF_SMALL_BENCHMARK, 256};
  EXPECT_EQ(measure_throughput(source).samplers.size(), 1U);
  source.cache = "/proc/no/such/place";
  EXPECT_EQ(measure_throughput(source).samplers.size(), 1U);
}

}  // namespace
}  // namespace lightproof
