#include "lightproof/history/store.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "lightproof/core/error.h"
#include "lightproof/core/random.h"
#include "lightproof/history/sqlite.h"

namespace lightproof {
namespace fs = std::filesystem;
namespace {

/// "LPRF": marks the file as ours (PRAGMA application_id).
constexpr std::uint32_t kApplication = 0x4c505246;
/// Version 1 had no errors. It is read as it is, and becomes this one before it is written to.
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kOldestVersion = 1;
constexpr std::string_view kMagic{"SQLite format 3\0", 16};

/// Tables, in the words that SQLite keeps of them.
constexpr std::string_view kRuns = R"(CREATE TABLE runs (
  id       INTEGER PRIMARY KEY,
  session  TEXT NOT NULL,
  started  INTEGER NOT NULL,
  machine  TEXT NOT NULL,
  compiler TEXT NOT NULL,
  flags    TEXT NOT NULL,
  "commit" TEXT NOT NULL,
  digest   INTEGER NOT NULL UNIQUE,
  checksum INTEGER NOT NULL))";
constexpr std::string_view kMeasurements = R"(CREATE TABLE measurements (
  run        INTEGER NOT NULL REFERENCES runs (id),
  benchmark  TEXT NOT NULL,
  metric     TEXT NOT NULL CHECK (metric IN ('ns', 'instructions', 'error')),
  repetition INTEGER NOT NULL,
  value      REAL NOT NULL CHECK (value > 0),
  PRIMARY KEY (run, benchmark, metric, repetition)) WITHOUT ROWID)";
/// Those of version 1.
constexpr std::string_view kEarlierMeasurements = R"(CREATE TABLE measurements (
  run        INTEGER NOT NULL REFERENCES runs (id),
  benchmark  TEXT NOT NULL,
  metric     TEXT NOT NULL CHECK (metric IN ('ns', 'instructions')),
  repetition INTEGER NOT NULL,
  value      REAL NOT NULL CHECK (value > 0),
  PRIMARY KEY (run, benchmark, metric, repetition)) WITHOUT ROWID)";
/// What a person would query.
constexpr std::string_view kView = R"(CREATE VIEW history AS
  SELECT machine, compiler, flags, "commit", benchmark, repetition, metric, value, run, session,
         datetime(started, 'unixepoch') AS started
  FROM measurements JOIN runs ON runs.id = measurements.run)";

/// Of several lines, as SQLite gives them, it makes one.
[[noreturn]] void refuse(const fs::path& file, std::string why) {
  std::ranges::replace(why, '\n', ' ');
  throw InputError(fmt::format("{}: {}", file.string(), why));
}

/// `what` is said unless the file is damaged.
[[noreturn]] void refuse(const fs::path& file, const char* what, const sqlite::Error& error) {
  refuse(file, fmt::format("{}: {}", error.damaged() ? "is damaged" : what, error.what()));
}

using Header = std::array<unsigned char, 100>;

std::uint32_t big_endian(const Header& header, std::size_t at) {
  return std::uint32_t{header[at]} << 24U | std::uint32_t{header[at + 1]} << 16U |
         std::uint32_t{header[at + 2]} << 8U | std::uint32_t{header[at + 3]};
}

/// Looks at the first bytes only ("The SQLite database file format", 1.3): what is not ours must
/// not even be opened by SQLite, which might recover or lock it.
void require_history(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) refuse(file, error ? error.message() : "is no file");
  Header header{};
  std::ifstream in(file, std::ios::binary);
  if (!in) refuse(file, fmt::format("cannot be read: {}", std::generic_category().message(errno)));
  in.read(reinterpret_cast<char*>(header.data()), header.size());
  const std::string_view start(reinterpret_cast<const char*>(header.data()), kMagic.size());
  if (in.gcount() < static_cast<std::streamsize>(header.size()) || start != kMagic) {
    refuse(file, "is no performance history: not an SQLite database");
  }
  if (big_endian(header, 68) != kApplication) {
    refuse(file, "is no performance history: an SQLite database of another program");
  }
  const std::uint32_t version = big_endian(header, 60);
  if (version < kOldestVersion || version > kVersion) {
    refuse(file, fmt::format("is a performance history of version {}; this program reads versions "
                             "{} to {}",
                             version, kOldestVersion, kVersion));
  }
}

/// Throws InputError if that cannot be known.
bool is_there(const fs::path& file) {
  std::error_code error;
  const bool there = fs::exists(file, error);
  if (error) refuse(file, error.message());
  return there;
}

void make_history(const fs::path& file) {
  sqlite::Database database(file, sqlite::Mode::create);
  sqlite::Transaction transaction(database);
  for (const std::string_view made : {kRuns, kMeasurements, kView}) {
    database.execute(std::string(made).c_str());
  }
  database.execute(
      fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", kApplication, kVersion)
          .c_str());
  transaction.commit();
  // Kept in the file: every later connection has it.
  database.execute("PRAGMA journal_mode = WAL");
}

/// The version as the database has it: the file's first bytes may lag behind its log.
std::int64_t version_of(sqlite::Database& database) {
  sqlite::Statement version(database, "PRAGMA user_version");
  return version.step() ? version.integer(0) : 0;
}

/// Makes the latest version of an earlier one, all at once.
void bring_up_to_date(sqlite::Database& database) {
  if (version_of(database) == kVersion) return;
  sqlite::Transaction transaction(database);
  // Another process may have been faster.
  if (version_of(database) != kVersion) {
    database.execute("DROP VIEW history; ALTER TABLE measurements RENAME TO earlier");
    database.execute(std::string(kMeasurements).c_str());
    database.execute("INSERT INTO measurements SELECT * FROM earlier; DROP TABLE earlier");
    database.execute(std::string(kView).c_str());
    database.execute(fmt::format("PRAGMA user_version = {}", kVersion).c_str());
  }
  transaction.commit();
}

/// Makes an empty history under another name and links it: whoever comes first wins, and nobody
/// ever sees half a file.
void create_history(const fs::path& file) {
  const fs::path temporary =
      file.parent_path() / fmt::format(".{}.{}.part", file.filename().string(), ::getpid());
  std::error_code ignored;
  fs::remove(temporary, ignored);
  try {
    make_history(temporary);
  } catch (const sqlite::Error& error) {
    fs::remove(temporary, ignored);
    refuse(file, "cannot be made", error);
  }
  std::error_code error;
  fs::create_hard_link(temporary, file, error);
  fs::remove(temporary, ignored);
  if (error && error != std::errc::file_exists) {
    refuse(file, fmt::format("cannot be made: {}", error.message()));
  }
}

/// The checksum of all that is stored of a run. SQLite notices broken pages, but not a broken
/// number in one.
std::int64_t checksum_of(const BenchmarkRun& run) {
  std::string text = fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}\n", run.session, run.started,
                                 run.machine, run.compiler, run.flags, run.commit, run.digest);
  std::vector<std::string> lines;
  for (const Measurement& m : run.measurements) {
    lines.push_back(
        fmt::format("{}\n{}\n{}\n{}\n", m.benchmark, to_string(m.metric), m.repetition, m.value));
  }
  std::sort(lines.begin(), lines.end());
  for (const std::string& line : lines) text += line;
  return static_cast<std::int64_t>(hash_text(text));
}

Metric metric_of(std::string_view unit) {
  for (const Metric metric : {Metric::instructions, Metric::error}) {
    if (unit == to_string(metric)) return metric;
  }
  return Metric::nanoseconds;
}

/// Whether something that a database holds is what a history is made of. A view is a person's, and
/// is not run here.
bool is_of_history(std::string_view type, std::string_view name, std::string_view made_by) {
  if (type == "view") return true;
  if (type == "index") return name.starts_with("sqlite_autoindex_") && made_by.empty();
  if (type != "table") return false;
  if (name == "runs") return made_by == kRuns;
  return name == "measurements" && (made_by == kMeasurements || made_by == kEarlierMeasurements);
}

/// A database is a program, too: triggers, checks, generated columns and tables that are views or
/// modules of SQLite run when it is looked at. Nothing but what is made here is looked at.
void require_tables(const fs::path& file, sqlite::Database& database) {
  sqlite::Statement objects(database, "SELECT type, name, sql FROM sqlite_master");
  int tables = 0;
  while (objects.step()) {
    const std::string type = objects.text(0);
    const std::string name = objects.text(1);
    if (!is_of_history(type, name, objects.text(2))) {
      refuse(file,
             fmt::format("is damaged, or no performance history of ours: the {} \"{}\" is not "
                         "what `lightproof history` makes; a copy without it can be read",
                         type, name));
    }
    tables += type == "table" ? 1 : 0;
  }
  if (tables != 2) refuse(file, "is damaged: a performance history has two tables");
}

/// One pass over all pages.
void require_intact(const fs::path& file, sqlite::Database& database) {
  sqlite::Statement check(database, "PRAGMA integrity_check(1)");
  const std::string found = check.step() ? check.text(0) : "no answer";
  if (found != "ok") refuse(file, fmt::format("is damaged: {}", found));
}

}  // namespace

struct HistoryStore::Connection {
  sqlite::Database database;
};

HistoryStore::HistoryStore(fs::path file, bool writable) : file_(std::move(file)) {
  require_history(file_);
  try {
    connection_ =
        std::make_unique<Connection>(Connection{sqlite::Database(file_, sqlite::Mode::existing)});
    // A run that was reported as added survives a power cut too. Readers are kept from writing here
    // and not by how the file is opened: the last one to close it tidies the write-ahead log away.
    connection_->database.execute(writable ? "PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON"
                                           : "PRAGMA query_only = ON");
    connection_->database.execute("PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON");
    require_tables(file_, connection_->database);
    require_intact(file_, connection_->database);
    if (writable) bring_up_to_date(connection_->database);
  } catch (const sqlite::Error& error) {
    refuse(file_, "cannot be used", error);
  }
}

HistoryStore::~HistoryStore() = default;
HistoryStore::HistoryStore(HistoryStore&& other) noexcept = default;

HistoryStore HistoryStore::open_to_read(const fs::path& file) {
  if (!is_there(file)) refuse(file, "there is no such file; `lightproof history add` makes one");
  return {file, false};
}

HistoryStore HistoryStore::open_to_write(const fs::path& file) {
  if (!is_there(file)) create_history(file);
  return {file, true};
}

std::optional<std::int64_t> HistoryStore::add(const BenchmarkRun& run) {
  try {
    sqlite::Database& database = connection_->database;
    sqlite::Transaction transaction(database);
    const auto digest = static_cast<std::int64_t>(run.digest);
    sqlite::Statement known(database, "SELECT id FROM runs WHERE digest = ?");
    if (known.bind(0, digest).step()) return std::nullopt;
    sqlite::Statement insert_run(database, R"(INSERT INTO
      runs (session, started, machine, compiler, flags, "commit", digest, checksum)
      VALUES (?, ?, ?, ?, ?, ?, ?, ?))");
    insert_run.bind(0, run.session).bind(1, run.started).bind(2, run.machine);
    insert_run.bind(3, run.compiler).bind(4, run.flags).bind(5, run.commit).bind(6, digest);
    insert_run.bind(7, checksum_of(run)).run();
    const std::int64_t id = database.last_row();
    sqlite::Statement insert(database, "INSERT INTO measurements VALUES (?, ?, ?, ?, ?)");
    for (const Measurement& m : run.measurements) {
      insert.bind(0, id).bind(1, m.benchmark).bind(2, std::string_view(to_string(m.metric)));
      insert.bind(3, std::int64_t{m.repetition}).bind(4, m.value).run();
    }
    transaction.commit();
    return id;
  } catch (const sqlite::Error& error) {
    refuse(file_, "cannot write", error);
  }
}

std::vector<BenchmarkRun> HistoryStore::runs() const {
  try {
    sqlite::Statement row(connection_->database, R"(
      SELECT runs.id, session, started, machine, compiler, flags, "commit", digest, checksum,
             benchmark, metric, repetition, value
      FROM runs JOIN measurements ON runs.id = measurements.run
      ORDER BY started, runs.id, benchmark, metric, repetition)");
    std::vector<BenchmarkRun> runs;
    std::vector<std::int64_t> checksums;
    std::int64_t last = -1;
    while (row.step()) {
      if (row.integer(0) != last) {
        last = row.integer(0);
        checksums.push_back(row.integer(8));
        runs.push_back({row.text(1),
                        row.integer(2),
                        row.text(3),
                        row.text(4),
                        row.text(5),
                        row.text(6),
                        static_cast<std::uint64_t>(row.integer(7)),
                        {}});
      }
      const Metric metric = metric_of(row.text(10));
      runs.back().measurements.push_back(
          {row.text(9), metric, static_cast<int>(row.integer(11)), row.real(12)});
    }
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (checksum_of(runs[i]) == checksums[i]) continue;
      refuse(file_, fmt::format("is damaged: the run of {} in session {} is not what was added",
                                runs[i].commit, runs[i].session));
    }
    return runs;
  } catch (const sqlite::Error& error) {
    refuse(file_, "cannot be read", error);
  }
}

}  // namespace lightproof
