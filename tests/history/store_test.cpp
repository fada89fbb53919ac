#include "lightproof/history/store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "lightproof/core/error.h"
#include "lightproof/core/temporary_folder.h"
#include "lightproof/history/sqlite.h"
#include "synthetic_runs.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

BenchmarkRun some_run(int number) {
  BenchmarkRun run = test::synthetic_run("commit", "session", number, {});
  for (int i = 0; i < 50; ++i) {
    run.measurements.push_back({"kernel", Metric::nanoseconds, i, 1.0 + 0.1 * i});
  }
  run.measurements.push_back({"kernel", Metric::instructions, 0, 1e12 + 1.0});
  return run;
}

TEST(HistoryStore, RefusesANameThatCannotBeLookedUp) {
  const TemporaryFolder folder;
  const fs::path file = folder / std::string(300, 'x');
  EXPECT_THROW(HistoryStore::open_to_read(file), InputError);
  EXPECT_THROW(HistoryStore::open_to_write(file), InputError);
}

class History : public testing::Test {
 protected:
  fs::path file() const { return folder_ / "history.db"; }

  void fill(int runs) const {
    HistoryStore store = HistoryStore::open_to_write(file());
    for (int i = 0; i < runs; ++i) store.add(some_run(i));
  }

  /// The refusals of both ways to open the file, which must leave it as it is.
  void expect_refused(const std::string& message) const {
    const std::string before = bytes_of(file());
    for (const auto& open : {HistoryStore::open_to_read, HistoryStore::open_to_write}) {
      try {
        open(file());
        ADD_FAILURE() << "opened";
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr(file().string()), HasSubstr(message)));
      }
    }
    EXPECT_TRUE(bytes_of(file()) == before) << "the file was touched";
    std::size_t names = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(file().parent_path())) ++names;
    EXPECT_EQ(names, 1U) << "files were left beside it";
  }

  void execute(const char* statements) const {
    sqlite::Database(file(), sqlite::Mode::create).execute(statements);
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(History, GivesBackWhatWasAdded) {
  const BenchmarkRun run = some_run(7);
  HistoryStore::open_to_write(file()).add(run);
  const std::vector<BenchmarkRun> runs = HistoryStore::open_to_read(file()).runs();
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].session, run.session);
  EXPECT_EQ(runs[0].started, run.started);
  EXPECT_EQ(runs[0].machine, run.machine);
  EXPECT_EQ(runs[0].compiler, run.compiler);
  EXPECT_EQ(runs[0].flags, run.flags);
  EXPECT_EQ(runs[0].commit, run.commit);
  EXPECT_EQ(runs[0].digest, run.digest);
  ASSERT_EQ(runs[0].measurements.size(), run.measurements.size());
  EXPECT_EQ(runs[0].measurements[0].metric, Metric::instructions);
  EXPECT_EQ(runs[0].measurements[0].value, 1e12 + 1.0);
  EXPECT_EQ(runs[0].measurements[3].repetition, 2);
  EXPECT_EQ(runs[0].measurements[3].value, run.measurements[2].value);
}

TEST_F(History, KeepsAnyText) {
  BenchmarkRun run = some_run(0);
  run.commit = "'; DROP TABLE runs; --\n\u00e9";
  HistoryStore::open_to_write(file()).add(run);
  EXPECT_EQ(HistoryStore::open_to_read(file()).runs().at(0).commit, run.commit);
}

TEST_F(History, TakesAFileOnce) {
  HistoryStore store = HistoryStore::open_to_write(file());
  const BenchmarkRun run = some_run(0);
  EXPECT_EQ(store.add(run), 1);
  EXPECT_EQ(store.add(run), std::nullopt);
  EXPECT_EQ(store.runs().size(), 1U);
}

TEST_F(History, IsInTheOrderOfTime) {
  HistoryStore store = HistoryStore::open_to_write(file());
  for (const int started : {30, 10, 20}) store.add(some_run(started));
  const std::vector<BenchmarkRun> runs = store.runs();
  EXPECT_EQ(runs[0].started, 10);
  EXPECT_EQ(runs[2].started, 30);
}

TEST_F(History, AddsARunWholeOrNotAtAll) {
  fill(1);
  BenchmarkRun bad = some_run(1);
  bad.measurements.push_back({"kernel", Metric::nanoseconds, 99, -1.0});
  HistoryStore store = HistoryStore::open_to_write(file());
  EXPECT_THROW(store.add(bad), InputError);
  EXPECT_EQ(HistoryStore::open_to_read(file()).runs().size(), 1U);
  EXPECT_EQ(store.add(some_run(2)), 2) << "the lock was not given back";
}

TEST_F(History, IsReadWhileItIsWritten) {
  HistoryStore writer = HistoryStore::open_to_write(file());
  writer.add(some_run(0));
  const HistoryStore reader = HistoryStore::open_to_read(file());
  writer.add(some_run(1));
  EXPECT_EQ(reader.runs().size(), 2U);
}

TEST_F(History, RefusesAMissingFileToRead) {
  EXPECT_THROW(HistoryStore::open_to_read(file()), InputError);
  EXPECT_FALSE(fs::exists(file()));
}

TEST_F(History, RefusesAFolderThatIsNotThere) {
  EXPECT_THROW(HistoryStore::open_to_write(file().parent_path() / "none" / "h.db"), InputError);
}

TEST_F(History, RefusesAFolder) {
  EXPECT_THROW(HistoryStore::open_to_write(file().parent_path()), InputError);
}

TEST_F(History, RefusesATextFile) {
  std::ofstream(file()) << "benchmark,value\n" << std::string(500, 'x');
  expect_refused("not an SQLite database");
}

TEST_F(History, RefusesAnEmptyFile) {
  std::ofstream(file()).flush();
  expect_refused("not an SQLite database");
}

TEST_F(History, RefusesTheDatabaseOfAnotherProgram) {
  execute("CREATE TABLE runs (id INTEGER)");
  expect_refused("another program");
}

TEST_F(History, RefusesAnotherVersion) {
  fill(1);
  execute("PRAGMA journal_mode = DELETE; PRAGMA user_version = 3");
  expect_refused("of version 3; this program reads versions 1 to 2");
}

TEST_F(History, OfTheFirstVersionIsReadAndBroughtUpToDate) {
  fill(2);
  // As version 1 was made: its measurements knew no errors.
  execute(
      "DROP VIEW history; ALTER TABLE measurements RENAME TO latest;"
      "CREATE TABLE measurements (\n"
      "  run        INTEGER NOT NULL REFERENCES runs (id),\n"
      "  benchmark  TEXT NOT NULL,\n"
      "  metric     TEXT NOT NULL CHECK (metric IN ('ns', 'instructions')),\n"
      "  repetition INTEGER NOT NULL,\n"
      "  value      REAL NOT NULL CHECK (value > 0),\n"
      "  PRIMARY KEY (run, benchmark, metric, repetition)) WITHOUT ROWID;"
      "INSERT INTO measurements SELECT * FROM latest; DROP TABLE latest;"
      "CREATE VIEW history AS SELECT value FROM measurements;"
      "PRAGMA user_version = 1");
  EXPECT_EQ(HistoryStore::open_to_read(file()).runs().size(), 2U);
  BenchmarkRun run = some_run(2);
  run.measurements.push_back({"kernel", Metric::error, 0, 0.25});
  EXPECT_EQ(HistoryStore::open_to_write(file()).add(run), 3);
  const std::vector<BenchmarkRun> runs = HistoryStore::open_to_read(file()).runs();
  ASSERT_EQ(runs.size(), 3U);
  const auto has_error = [](const Measurement& m) {
    return m.metric == Metric::error && m.value == 0.25;
  };
  EXPECT_TRUE(std::ranges::any_of(runs[2].measurements, has_error));
  EXPECT_TRUE(std::ranges::none_of(runs[1].measurements, has_error));
}

std::string values_of(const std::vector<BenchmarkRun>& runs) {
  std::string text;
  for (const BenchmarkRun& run : runs) {
    text += run.commit + run.session + std::to_string(run.started) + "\n";
    for (const Measurement& m : run.measurements) text += m.benchmark + std::to_string(m.value);
  }
  return text;
}

// Wherever damage falls: refused, or in bytes that hold nothing; never other numbers.
TEST_F(History, RefusesADamagedFile) {
  fill(20);
  const std::string intact = bytes_of(file());
  const std::string values = values_of(HistoryStore::open_to_read(file()).runs());
  int refused = 0;
  for (std::size_t at = 100; at + 8 < intact.size(); at += 321) {
    std::string bytes = intact;
    for (std::size_t i = at; i < at + 8; ++i) bytes[i] = static_cast<char>(bytes[i] ^ 0x5a);
    std::ofstream(file(), std::ios::binary) << bytes;
    try {
      EXPECT_EQ(values_of(HistoryStore::open_to_read(file()).runs()), values) << at;
    } catch (const InputError& error) {
      ++refused;
      EXPECT_THAT(error.what(), AllOf(HasSubstr(file().string()), HasSubstr("is damaged"))) << at;
    }
    EXPECT_TRUE(bytes_of(file()) == bytes) << "the file was touched";
  }
  EXPECT_GT(refused, 50) << "nothing was hit";
}

TEST_F(History, RefusesAFileThatWasCutShort) {
  fill(40);
  fs::resize_file(file(), fs::file_size(file()) / 2);
  expect_refused("is damaged");
}

// What runs when it is looked at is not looked at: a view without an end, a check that takes all
// memory, somebody else's tables.
TEST_F(History, RefusesTablesThatAreNotItsOwn) {
  const std::vector<std::string> harms = {
      R"(DROP VIEW history; DROP TABLE runs;
         CREATE VIEW runs AS WITH RECURSIVE n(id) AS (SELECT 1 UNION ALL SELECT id + 1 FROM n)
         SELECT id, '' AS session, 0 AS started, '' AS machine, '' AS compiler, '' AS flags,
         '' AS "commit", id AS digest, 0 AS checksum FROM n)",
      R"(CREATE TABLE more (bytes CHECK (length(zeroblob(1000000000)) > 0));
         INSERT INTO more VALUES (1))",
      "CREATE TRIGGER late AFTER INSERT ON runs BEGIN DELETE FROM runs; END",
      "CREATE INDEX slow ON runs (length(zeroblob(1000000000)))",
      "DROP VIEW history; ALTER TABLE runs ADD COLUMN more AS (zeroblob(1000000000))",
      "DROP VIEW history; DROP TABLE measurements"};
  for (const std::string& harm : harms) {
    SCOPED_TRACE(harm);
    fs::remove(file());
    fill(1);
    execute(("PRAGMA journal_mode = DELETE;" + harm).c_str());
    expect_refused("is damaged");
  }
}

TEST_F(History, MayHaveViewsOfItsOwner) {
  fill(1);
  execute("CREATE VIEW mine AS SELECT value FROM history");
  EXPECT_EQ(HistoryStore::open_to_read(file()).runs().size(), 1U);
  EXPECT_EQ(HistoryStore::open_to_write(file()).add(some_run(1)), 2);
}

// SQLite says what is damaged in several lines.
TEST_F(History, RefusesDamageInOneLine) {
  fill(1);
  execute("PRAGMA journal_mode = DELETE");
  std::size_t said = 0;
  const std::string whole = bytes_of(file());
  for (std::size_t at = 4096; at < whole.size(); at += 509) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x55);
    std::ofstream(file(), std::ios::binary) << bytes;
    try {
      HistoryStore::open_to_read(file()).runs();
    } catch (const InputError& error) {
      EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
      ++said;
    }
  }
  EXPECT_GT(said, 3U);
}

}  // namespace
}  // namespace lightproof
