#include "lightproof/history/google_benchmark.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "lightproof/core/error.h"
#include "lightproof/core/temporary_folder.h"

namespace lightproof {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

Json document() {
  return {{"context",
           {{"date", "2026-01-31T13:00:00+01:00"},
            {"host_name", "host"},
            {"num_cpus", 4},
            {"machine", "EPYC"},
            {"compiler", "GNU 12"},
            {"flags", "-O3"},
            {"commit", "abc"}}},
          {"benchmarks",
           {{{"name", "kernel/1"},
             {"run_name", "kernel/1"},
             {"run_type", "iteration"},
             {"repetition_index", 0},
             {"cpu_time", 1.5},
             {"real_time", 2.5},
             {"time_unit", "us"}}}}};
}

class GoogleBenchmark : public testing::Test {
 protected:
  BenchmarkRun read(const std::string& text, const std::string& commit = "") {
    std::ofstream(file()) << text;
    return read_google_benchmark(file(), commit);
  }
  BenchmarkRun read(const Json& json, const std::string& commit = "") {
    return read(json.dump(), commit);
  }

  template <class Content>
  std::string refusal_of(const Content& content) {
    try {
      read(content);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path file() const { return folder_ / "result.json"; }

 private:
  TemporaryFolder folder_;
};

TEST_F(GoogleBenchmark, GivesTheRunOfAFile) {
  const BenchmarkRun run = read(document());
  EXPECT_EQ(run.started, 1769860800);  // date -u -d 2026-01-31T12:00:00 +%s
  EXPECT_EQ(run.machine, "EPYC");
  EXPECT_EQ(run.compiler, "GNU 12");
  EXPECT_EQ(run.flags, "-O3");
  EXPECT_EQ(run.commit, "abc");
  ASSERT_EQ(run.measurements.size(), 1U);
  EXPECT_EQ(run.measurements[0].benchmark, "kernel/1");
  EXPECT_EQ(run.measurements[0].metric, Metric::nanoseconds);
  EXPECT_EQ(run.measurements[0].value, 1500.0);
}

TEST_F(GoogleBenchmark, TakesTheWallClockWhereTheNameSaysSo) {
  Json json = document();
  json["benchmarks"][0]["run_name"] = "kernel/real_time";
  EXPECT_EQ(read(json).measurements[0].value, 2500.0);
}

TEST_F(GoogleBenchmark, TakesInstructionsInPlaceOfTime) {
  Json json = document();
  json["benchmarks"][0]["instructions"] = 12345;
  const BenchmarkRun run = read(json);
  ASSERT_EQ(run.measurements.size(), 1U);
  EXPECT_EQ(run.measurements[0].metric, Metric::instructions);
  EXPECT_EQ(run.measurements[0].value, 12345.0);
}

TEST_F(GoogleBenchmark, TakesAnErrorInPlaceOfTime) {
  Json json = document();
  json["benchmarks"][0]["error"] = 0.125;
  const BenchmarkRun run = read(json);
  ASSERT_EQ(run.measurements.size(), 1U);
  EXPECT_EQ(run.measurements[0].benchmark, "kernel/1");
  EXPECT_EQ(run.measurements[0].metric, Metric::error);
  EXPECT_EQ(run.measurements[0].value, 0.125);
}

TEST_F(GoogleBenchmark, KeepsErrorsBesideTheTime) {
  Json json = document();
  json["benchmarks"][0]["rms_error"] = 0.5;
  json["benchmarks"][0]["largest_error"] = 0.0;
  const BenchmarkRun run = read(json);
  ASSERT_EQ(run.measurements.size(), 2U);
  EXPECT_EQ(run.measurements[0].benchmark, "kernel/1:rms_error");
  EXPECT_EQ(run.measurements[0].metric, Metric::error);
  EXPECT_EQ(run.measurements[0].value, 0.5);
  EXPECT_EQ(run.measurements[1].metric, Metric::nanoseconds);
}

TEST_F(GoogleBenchmark, LeavesOutAggregates) {
  Json json = document();
  json["benchmarks"].push_back(json["benchmarks"][0]);
  json["benchmarks"][1]["run_type"] = "aggregate";
  EXPECT_EQ(read(json).measurements.size(), 1U);
}

TEST_F(GoogleBenchmark, TakesTheGivenCommitBeforeTheOneOfTheFile) {
  Json json = document();
  EXPECT_EQ(read(json, "given").commit, "given");
  json["context"].erase("commit");
  EXPECT_EQ(read(json, "given").commit, "given");
  EXPECT_THAT(refusal_of(json), AllOf(HasSubstr("result.json"), HasSubstr("--commit")));
}

TEST_F(GoogleBenchmark, NamesTheHostWhereThereIsNoMachine) {
  Json json = document();
  json["context"].erase("machine");
  EXPECT_EQ(read(json).machine, "host, 4 CPUs");
}

TEST_F(GoogleBenchmark, SetsFilesApartByTheirContent) {
  Json json = document();
  const std::uint64_t digest = read(json).digest;
  EXPECT_EQ(read(json).digest, digest);
  json["benchmarks"][0]["cpu_time"] = 1.6;
  EXPECT_NE(read(json).digest, digest);
}

TEST_F(GoogleBenchmark, RefusesWhatIsNoJsonWithThePlace) {
  EXPECT_THAT(refusal_of(std::string("{\"context\": {},\n  oops")),
              AllOf(HasSubstr("result.json"), HasSubstr("line 2, column 3")));
  EXPECT_THAT(refusal_of(std::string()), HasSubstr("is empty"));
  EXPECT_THAT(refusal_of(std::string("[]")), HasSubstr("no JSON object"));
  const std::string whole = document().dump();
  for (std::size_t length = 1; length < whole.size(); length += 7) {
    EXPECT_THAT(refusal_of(whole.substr(0, length)), HasSubstr("result.json")) << length;
  }
}

TEST_F(GoogleBenchmark, RefusesAMissingFile) {
  try {
    read_google_benchmark("/nowhere/result.json");
    FAIL() << "read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/result.json: cannot be read"));
  }
}

struct Fault {
  const char* name;
  const char* pointer;  ///< of the value that is replaced
  Json value;           ///< discarded: the value is removed
  const char* message;

  friend void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }
};

class FaultyFile : public GoogleBenchmark, public testing::WithParamInterface<Fault> {};

TEST_P(FaultyFile, IsRefusedWithThePlaceAndTheReason) {
  Json json = document();
  const Json::json_pointer pointer(GetParam().pointer);
  if (GetParam().value.is_discarded()) {
    json[pointer.parent_pointer()].erase(pointer.back());
  } else {
    json[pointer] = GetParam().value;
  }
  EXPECT_THAT(refusal_of(json), AllOf(HasSubstr("result.json: "), HasSubstr(GetParam().message)));
}

const Json kRemoved = Json(Json::value_t::discarded);

INSTANTIATE_TEST_SUITE_P(
    Faults, FaultyFile,
    testing::Values(
        Fault{"NoContext", "/context", kRemoved, "\"context\" is missing"},
        Fault{"NoBenchmarks", "/benchmarks", kRemoved, "\"benchmarks\" is missing"},
        Fault{"BenchmarksOfAnotherType", "/benchmarks", 3, "benchmarks: is no array"},
        Fault{"NoMeasurement", "/benchmarks", Json::array(), "holds no measurement"},
        Fault{"EntryOfAnotherType", "/benchmarks/0", "x", "benchmarks[0]: is no object"},
        Fault{"BadDate", "/context/date", "yesterday", "context.date: \"yesterday\""},
        Fault{"NoTime", "/benchmarks/0/cpu_time", kRemoved, "benchmarks[0]: \"cpu_time\""},
        Fault{"TimeInWords", "/benchmarks/0/cpu_time", "fast", "benchmarks[0].cpu_time: \"fast\""},
        Fault{"TimeOfZero", "/benchmarks/0/cpu_time", 0, "benchmarks[0].cpu_time: 0 is not"},
        Fault{"NegativeTime", "/benchmarks/0/cpu_time", -1, "not a positive number"},
        Fault{"UnknownUnit", "/benchmarks/0/time_unit", "h", "benchmarks[0].time_unit: \"h\""},
        Fault{"NoName", "/benchmarks/0/run_name", kRemoved, "\"run_name\" is missing"},
        Fault{"EmptyName", "/benchmarks/0/run_name", "", "run_name: is empty"},
        Fault{"NumberForText", "/context/flags", 3, "context.flags: 3"},
        Fault{"RepetitionInWords", "/benchmarks/0/repetition_index", "one", "result.json"},
        Fault{"Failed", "/benchmarks/0/error_occurred", true, "kernel/1 failed"},
        Fault{"NoCommit", "/context/commit", kRemoved, "--commit"}),
    [](const auto& test) { return test.param.name; });

TEST_F(GoogleBenchmark, RefusesARepetitionThatIsThereTwice) {
  Json json = document();
  json["benchmarks"].push_back(json["benchmarks"][0]);
  EXPECT_THAT(refusal_of(json),
              HasSubstr("benchmarks[1]: repetition 0 of kernel/1 is there twice"));
}

// Copying or printing such a value would overflow the stack.
TEST_F(GoogleBenchmark, RefusesValuesThatLieTooDeepInEachOther) {
  for (const std::string& open : {std::string(1'000'000, '['), std::string(65, '[')}) {
    const std::string close(open.size(), ']');
    EXPECT_THAT(refusal_of(open + close), HasSubstr("lie too deep in each other"));
    EXPECT_THAT(refusal_of(open), HasSubstr("lie too deep in each other"));
  }
  std::string text = document().dump();
  text.insert(text.size() - 1, ", \"more\": " + std::string(63, '[') + std::string(63, ']'));
  EXPECT_EQ(refusal_of(text), "");
}

TEST_F(GoogleBenchmark, RefusesWholeNumbersThatAreNone) {
  for (const Json& number : {Json(1e300), Json(-1), Json(0.5), Json(1LL << 40U), Json("1")}) {
    Json json = document();
    json["benchmarks"][0]["repetition_index"] = number;
    EXPECT_THAT(refusal_of(json), HasSubstr("benchmarks[0].repetition_index: " + number.dump()));
    json = document();
    json["context"].erase("machine");
    json["context"]["num_cpus"] = number;
    EXPECT_THAT(refusal_of(json), HasSubstr("context.num_cpus: " + number.dump()));
  }
}

TEST_F(GoogleBenchmark, RefusesATimeThatIsTooLongForANumber) {
  Json json = document();
  json["benchmarks"][0]["time_unit"] = "s";
  json["benchmarks"][0]["cpu_time"] = 1e300;
  EXPECT_THAT(refusal_of(json), HasSubstr("benchmarks[0].cpu_time: inf is not a positive number"));
}

TEST_F(GoogleBenchmark, ShowsTheBeginningOfWhatIsNotOfTheRightType) {
  Json json = document();
  json["benchmarks"][0]["cpu_time"] = std::string(100'000, 'x');
  const std::string refusal = refusal_of(json);
  EXPECT_THAT(refusal, HasSubstr("…"));
  EXPECT_LT(refusal.size(), 400U);
}

TEST(GoogleBenchmarkFile, MayNotBeAFolder) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_google_benchmark(folder / ""), InputError);
}

}  // namespace
}  // namespace lightproof
