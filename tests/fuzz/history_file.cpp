// The history, whose file is an SQLite database: its bytes changed by the input, or what stands in
// it by statements that the input is.
#include <sqlite3.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "lightproof/core/temporary_folder.h"
#include "lightproof/history/sqlite.h"
#include "lightproof/history/store.h"
#include "tests/fuzz/fuzz.h"

namespace lightproof::fuzz {
namespace {

namespace fs = std::filesystem;

BenchmarkRun some_run(int number) {
  BenchmarkRun run = {"session", number, "machine", "compiler", "flags", "commit", 0, {}};
  run.digest = static_cast<std::uint64_t>(number);
  for (int i = 0; i < 3; ++i)
    run.measurements.push_back({"kernel", Metric::nanoseconds, i, 1.0 + i});
  return run;
}

/// A history of two runs, as bytes: nothing is left of it in a log.
std::string whole_history() {
  const TemporaryFolder folder;
  const fs::path file = folder / "history.db";
  {
    HistoryStore store = HistoryStore::open_to_write(file);
    store.add(some_run(1));
    store.add(some_run(2));
  }
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The bytes with some changed: each change is a place, a count, and what comes there.
std::string changed(std::string bytes, Input& input) {
  while (!input.is_empty()) {
    const std::size_t place = input.take<std::uint16_t>() % bytes.size();
    for (std::size_t left = 1 + input.below(8), at = place; left > 0 && at < bytes.size(); --left) {
      bytes[at++] = static_cast<char>(input.take<std::uint8_t>());
    }
    if (input.below(16) == 0) bytes.resize(std::max<std::size_t>(place, 1));
  }
  return bytes;
}

/// No other file is opened or written, and nothing in this process is changed.
int allow(void* /*nothing*/, int action, const char* /*a*/, const char* /*b*/, const char* /*c*/,
          const char* /*d*/) {
  const bool is_denied =
      action == SQLITE_ATTACH || action == SQLITE_DETACH || action == SQLITE_PRAGMA;
  return is_denied ? SQLITE_DENY : SQLITE_OK;
}

/// Statements of the input may have no end themselves.
int stop(void* /*nothing*/) { return 1; }

void run_statements(const fs::path& file, const std::string& statements) {
  constexpr int kMostSteps = 100'000;
  sqlite::Database database(file, sqlite::Mode::existing);
  sqlite3_limit(database.handle(), SQLITE_LIMIT_LENGTH, 100'000);
  sqlite3_progress_handler(database.handle(), kMostSteps, stop, nullptr);
  sqlite3_set_authorizer(database.handle(), allow, nullptr);
  try {
    database.execute(statements.c_str());
  } catch (const sqlite::Error&) {  // the statement that fails is the last one
  } catch (const std::bad_alloc&) {
  }
}

void read_and_write(const fs::path& file) {
  accepts([&] {
    for (const BenchmarkRun& run : HistoryStore::open_to_read(file).runs()) {
      if (run.measurements.empty()) fail("a run without measurements");
    }
  });
  accepts([&] {
    HistoryStore store = HistoryStore::open_to_write(file);
    store.add(some_run(3));
    store.runs();
  });
}

}  // namespace
}  // namespace lightproof::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lightproof;
  static const std::string whole = fuzz::whole_history();
  fuzz::Input input(data, size);
  const bool by_statements = input.below(2) == 0;
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "history.db";
  std::ofstream(file, std::ios::binary) << (by_statements ? whole : fuzz::changed(whole, input));
  if (by_statements) fuzz::run_statements(file, std::string(input.text()));
  fuzz::read_and_write(file);
  return 0;
}
