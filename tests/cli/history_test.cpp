// lightproof history as its users meet it: files in, exit codes and words out; writers that are
// killed, writers that meet.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

#include "lightproof/history/store.h"
#include "tests/cli/program.h"
#include "tests/cli/schema.h"

namespace lightproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using std::chrono::milliseconds;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// What one process of a benchmark program says.
struct Result {
  std::string commit;
  int second = 0;  ///< of its start
  double ns = 100.0;
  int benchmarks = 1;  ///< of the same time
};

std::string text_of(const Result& result) {
  json benchmarks = json::array();
  for (int i = 0; i < result.benchmarks; ++i) {
    benchmarks.push_back({{"run_name", "kernel/" + std::to_string(i)},
                          {"run_type", "iteration"},
                          {"repetition_index", 0},
                          {"cpu_time", result.ns},
                          {"real_time", result.ns},
                          {"time_unit", "ns"}});
  }
  char date[] = "2026-01-31T12:00:00+00:00";
  date[14] = static_cast<char>('0' + result.second / 600);
  date[15] = static_cast<char>('0' + result.second / 60 % 10);
  date[17] = static_cast<char>('0' + result.second % 60 / 10);
  date[18] = static_cast<char>('0' + result.second % 10);
  const json document = {{"context",
                          {{"date", date},
                           {"machine", "machine"},
                           {"compiler", "compiler"},
                           {"flags", "flags"},
                           {"commit", result.commit}}},
                         {"benchmarks", benchmarks}};
  return document.dump();
}

class HistoryCommand : public testing::Test {
 protected:
  fs::path path(const std::string& name = "") const { return folder_ / name; }

  void write(const std::string& name, const Result& result) const {
    write_bytes(path(name), text_of(result));
  }

  Finished history(Words words) const {
    words.insert(words.begin(), "history");
    words.insert(words.end(), {"--db", "h.db"});
    return lightproof(words, path());
  }

  /// Adds ten runs of base and head as one session; head takes `ratio` times as long.
  void add_session(const std::string& name, double ratio, int start) const {
    Words words = {"add", "--session", name};
    for (int i = 0; i < 20; ++i) {
      const bool head = i % 4 == 1 || i % 4 == 2;
      const std::string file = name + std::to_string(i) + ".json";
      write(file, {head ? "head" : "base", start + i, (100.0 + 0.1 * i) * (head ? ratio : 1.0)});
      words.push_back(file);
    }
    const Finished added = history(words);
    ASSERT_EQ(added.exit_code, 0) << added.err;
  }

  /// Files of many benchmarks each, so that adding them takes a while.
  Words write_large(const std::string& name, int files) const {
    Words words;
    for (int i = 0; i < files; ++i) {
      words.push_back(name + std::to_string(i) + ".json");
      write(words.back(), {name, i, 100.0 + i, kLarge});
    }
    return words;
  }

  std::vector<BenchmarkRun> runs() const { return HistoryStore::open_to_read(path("h.db")).runs(); }

  static constexpr int kLarge = 500;

 private:
  TemporaryFolder folder_;
};

TEST_F(HistoryCommand, AddsFilesAndSaysSo) {
  write("a.json", {"abc"});
  const Finished added = history({"add", "a.json"});
  EXPECT_EQ(added.exit_code, 0) << added.err;
  EXPECT_EQ(added.out, "a.json: run 1 of abc, 1 values\n");
  EXPECT_EQ(history({"add", "a.json"}).out, "a.json: is there already\n");
  EXPECT_EQ(runs().size(), 1U);
  EXPECT_THAT(history({"add", "-q", "a.json"}).out, IsEmpty());
}

TEST_F(HistoryCommand, RefusesBadFilesWithoutAddingTheGoodOnes) {
  write("a.json", {"abc"});
  write_bytes(path("b.json"), "{\n  oops");
  const Finished added = history({"add", "a.json", "b.json"});
  EXPECT_EQ(added.exit_code, 2);
  EXPECT_THAT(added.err, AllOf(StartsWith("lightproof: b.json: "), HasSubstr("line 2")));
  EXPECT_FALSE(fs::exists(path("h.db")));
}

TEST_F(HistoryCommand, RefusesAFileWithoutACommitUnlessOneIsGiven) {
  write("a.json", {""});
  EXPECT_THAT(history({"add", "a.json"}).err, HasSubstr("--commit"));
  EXPECT_EQ(history({"add", "a.json", "--commit", "abc"}).exit_code, 0);
  EXPECT_EQ(runs().at(0).commit, "abc");
}

TEST_F(HistoryCommand, LeavesTheFilesOfOthersAlone) {
  write("a.json", {"abc"});
  write_bytes(path("h.db"), "not a database\n");
  for (const Words& words :
       {Words{"add", "a.json"}, Words{"compare", "a", "b"}, Words{"trend", "-o", "t.html"}}) {
    const Finished refused = history(words);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, AllOf(StartsWith("lightproof: h.db: "), HasSubstr("no performance")));
  }
  EXPECT_EQ(bytes_of(path("h.db")), "not a database\n");
  EXPECT_FALSE(fs::exists(path("t.html")));
}

TEST_F(HistoryCommand, ComparesWithExitCodes) {
  add_session("first", 1.2, 0);
  const Finished suspected = history({"compare", "base", "head"});
  EXPECT_EQ(suspected.exit_code, 0) << suspected.err;
  EXPECT_THAT(suspected.out, HasSubstr("suspected  kernel/0"));
  add_session("second", 1.2, 100);
  const Finished regressed =
      history({"compare", "base", "head", "--json", "c.json", "--markdown", "c.md"});
  EXPECT_EQ(regressed.exit_code, 1) << regressed.err;
  EXPECT_THAT(regressed.out, HasSubstr("regressed  kernel/0"));
  EXPECT_EQ(json_of(path("c.json")).at("outcome"), "regressed");
  EXPECT_THAT(bytes_of(path("c.md")), HasSubstr("| regressed | kernel/0 | ns |"));
  EXPECT_EQ(history({"compare", "head", "base"}).exit_code, 0) << "faster is no regression";
}

TEST_F(HistoryCommand, AnnotatesWhatIsSlowerEvenIfQuiet) {
  add_session("first", 1.2, 0);
  const Words compare = {"compare", "base", "head", "--github", "-q"};
  EXPECT_EQ(history({"compare", "base", "base", "-q"}).exit_code, 2);
  EXPECT_THAT(
      history(compare).out,
      AllOf(StartsWith("::warning title=lightproof%3A kernel/0::suspected: "), HasSubstr("+20")));
  add_session("second", 1.2, 100);
  const Finished regressed = history(compare);
  EXPECT_EQ(regressed.exit_code, 1);
  EXPECT_THAT(regressed.out, StartsWith("::error title=lightproof%3A kernel/0::regressed: "));
  EXPECT_EQ(std::count(regressed.out.begin(), regressed.out.end(), '\n'), 1) << regressed.out;
}

TEST_F(HistoryCommand, SaysWhatSuspectedMeans) {
  EXPECT_THAT(
      lightproof({"history", "compare", "--help"}).out,
      AllOf(HasSubstr("suspected"), HasSubstr("0 nothing regressed"), HasSubstr("--github")));
}

TEST_F(HistoryCommand, WritesToTheStandardOutput) {
  add_session("first", 1.0, 0);
  const Finished compared = history({"compare", "base", "head", "--json", "-"});
  EXPECT_EQ(json::parse(compared.out).at("outcome"), "passed");
  EXPECT_THAT(compared.err, HasSubstr("kernel/0"));
  EXPECT_THAT(history({"trend", "-o", "-"}).out, StartsWith("<!doctype html>"));
  EXPECT_FALSE(fs::exists(path("-")));
}

TEST_F(HistoryCommand, WritesJsonThatItsSchemaDescribes) {
  add_session("first", 1.2, 0);
  EXPECT_EQ(history({"compare", "base", "head", "--json", "c.json", "-q"}).exit_code, 0);
  expect_valid("comparison.schema.json", path("c.json"));
  add_session("second", 1.2, 100);
  EXPECT_EQ(history({"compare", "base", "head", "--json", "c.json", "-q"}).exit_code, 1);
  expect_valid("comparison.schema.json", path("c.json"));
}

TEST_F(HistoryCommand, LetsNoNameControlTheTerminal) {
  write("a\x1b[2J.json", {"abc\x1b[2J"});
  const Finished added = history({"add", "a\x1b[2J.json"});
  EXPECT_EQ(added.exit_code, 0) << added.err;
  EXPECT_THAT(added.out, AllOf(HasSubstr("a\\x1b[2J"), testing::Not(HasSubstr("\x1b"))));
}

TEST_F(HistoryCommand, RefusesWhatCannotBeCompared) {
  add_session("first", 1.0, 0);
  for (const Words& words : {Words{"compare", "base", "tail"}, Words{"compare", "base", "base"}}) {
    const Finished refused = history(words);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.out, IsEmpty());
    EXPECT_THAT(refused.err, StartsWith("lightproof: "));
  }
  EXPECT_EQ(lightproof({"history", "compare", "a", "b", "--db", "none.db"}, path()).exit_code, 2);
  EXPECT_FALSE(fs::exists(path("none.db")));
}

TEST_F(HistoryCommand, WritesTheTrendAsOnePage) {
  add_session("first", 1.0, 0);
  const Finished trend = history({"trend", "-o", "t.html"});
  EXPECT_EQ(trend.exit_code, 0) << trend.err;
  EXPECT_NE(bytes_of(path("t.html")).find("id=\"trend-1\""), std::string::npos);
  EXPECT_EQ(history({"trend", "-o", "none/t.html"}).exit_code, 2);
}

/// Milliseconds at which a writer is killed: some that are known to matter, and random ones, as
/// many as LIGHTPROOF_FAULTS says (ci/faults).
std::vector<int> moments_of_death() {
  std::vector<int> moments = {0, 5, 20, 50, 100, 200};
  const char* more = std::getenv("LIGHTPROOF_FAULTS");
  const char* seed = std::getenv("LIGHTPROOF_FAULT_SEED");
  std::mt19937_64 engine(seed == nullptr ? 1 : std::stoull(seed));
  for (int i = more == nullptr ? 0 : std::stoi(more); i > 0; --i) {
    moments.push_back(std::uniform_int_distribution<int>(0, 400)(engine));
  }
  return moments;
}

/// Each at another moment of the writing.
class KilledWriter : public HistoryCommand, public testing::WithParamInterface<int> {};

TEST_P(KilledWriter, LosesNothingThatItReportedAndLeavesNothingHalf) {
  const Words files = write_large("commit", 60);
  Words words = {"history", "add", "--db", "h.db"};
  words.insert(words.end(), files.begin(), files.end());
  Process writer(lightproof_command(words, path()));
  while (!fs::exists(path("h.db"))) std::this_thread::sleep_for(milliseconds(1));
  std::this_thread::sleep_for(milliseconds(GetParam()));
  writer.send(SIGKILL);
  const Finished killed = writer.wait();
  const auto reported =
      static_cast<std::size_t>(std::count(killed.out.begin(), killed.out.end(), '\n'));
  const std::vector<BenchmarkRun> there = runs();
  EXPECT_GE(there.size(), reported);
  EXPECT_LE(there.size(), reported + 1) << "a run is on the disk before it is reported, no other";
  for (const BenchmarkRun& run : there) EXPECT_EQ(run.measurements.size(), kLarge);
  words.insert(words.begin() + 2, "-q");
  EXPECT_EQ(lightproof(words, path()).exit_code, 0) << "a dead writer's lock stays";
  EXPECT_EQ(runs().size(), files.size());
}

INSTANTIATE_TEST_SUITE_P(Milliseconds, KilledWriter, testing::ValuesIn(moments_of_death()));

TEST_F(HistoryCommand, OnAFullDiskKeepsWhatWasThere) {
  write("a.json", {"abc"});
  ASSERT_EQ(history({"add", "a.json"}).exit_code, 0);
  const Words files = write_large("commit", 20);
  Command command = lightproof_command({"history", "add", "--db", "h.db"}, path());
  command.words.insert(command.words.end(), files.begin(), files.end());
  command.words.insert(command.words.begin(), {"bash", "-c", "ulimit -f 100; exec \"$@\"", "bash"});
  const Finished full = run(command);
  EXPECT_EQ(full.exit_code, 2) << full.err;
  EXPECT_THAT(full.err, AllOf(StartsWith("lightproof: h.db: "), HasSubstr("cannot write")));
  const auto reported =
      static_cast<std::size_t>(std::count(full.out.begin(), full.out.end(), '\n'));
  EXPECT_EQ(runs().size(), 1 + reported);
  Words again = {"add", "-q"};
  again.insert(again.end(), files.begin(), files.end());
  EXPECT_EQ(history(again).exit_code, 0);
  EXPECT_EQ(runs().size(), 21U);
}

TEST_F(HistoryCommand, LetsSeveralWritersAndReadersMeet) {
  std::vector<std::unique_ptr<Process>> writers;
  for (const std::string name : {"a", "b", "c"}) {
    Words words = {"history", "add", "--db", "h.db"};
    for (const std::string& file : write_large(name, 20)) words.push_back(file);
    writers.push_back(std::make_unique<Process>(lightproof_command(words, path())));
  }
  while (!fs::exists(path("h.db"))) std::this_thread::sleep_for(milliseconds(1));
  for (int i = 0; i < 5; ++i) {
    for (const BenchmarkRun& run : runs()) ASSERT_EQ(run.measurements.size(), kLarge);
  }
  for (const auto& writer : writers) {
    const Finished finished = writer->wait();
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
  }
  EXPECT_EQ(runs().size(), 60U);
  Words left = names_in(path());
  std::erase_if(left, [](const std::string& name) { return name.ends_with(".json"); });
  EXPECT_EQ(left, Words{"h.db"});
}

}  // namespace
}  // namespace lightproof::test
