#include "lightproof/history/sqlite.h"

#include <sqlite3.h>

#include <new>
#include <utility>

namespace lightproof::sqlite {
namespace {

/// Another writer holds the lock for milliseconds.
constexpr int kPatienceMilliseconds = 30000;

int flags_of(Mode mode) {
  return mode == Mode::create ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READWRITE;
}

/// Lack of memory is nothing that the database could be blamed for.
[[noreturn]] void fail(int code, const std::string& why) {
  if (code == SQLITE_NOMEM) throw std::bad_alloc();
  throw Error(code, why);
}

}  // namespace

Error::Error(int code, const std::string& message)
    : std::runtime_error(message), damaged_(code == SQLITE_CORRUPT || code == SQLITE_NOTADB) {}

Database::Database(const std::filesystem::path& file, Mode mode) {
  const int code = sqlite3_open_v2(file.c_str(), &handle_, flags_of(mode), nullptr);
  if (code != SQLITE_OK) {
    const std::string why = handle_ == nullptr ? "out of memory" : sqlite3_errmsg(handle_);
    sqlite3_close(handle_);
    fail(code, why);
  }
  sqlite3_busy_timeout(handle_, kPatienceMilliseconds);
}

Database::~Database() { sqlite3_close(handle_); }

Database::Database(Database&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}

void Database::execute(const char* statements) {
  const int code = sqlite3_exec(handle_, statements, nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(code, sqlite3_errmsg(handle_));
}

std::int64_t Database::last_row() const { return sqlite3_last_insert_rowid(handle_); }

Statement::Statement(Database& database, const char* text) : database_(database.handle()) {
  require(sqlite3_prepare_v2(database_, text, -1, &handle_, nullptr));
}

Statement::~Statement() { sqlite3_finalize(handle_); }

void Statement::require(int code) const {
  if (code != SQLITE_OK) fail(code, sqlite3_errmsg(database_));
}

Statement& Statement::bind(int parameter, std::string_view text) {
  require(sqlite3_bind_text64(handle_, parameter + 1, text.data(), text.size(), SQLITE_TRANSIENT,
                              SQLITE_UTF8));
  return *this;
}

Statement& Statement::bind(int parameter, std::int64_t number) {
  require(sqlite3_bind_int64(handle_, parameter + 1, number));
  return *this;
}

Statement& Statement::bind(int parameter, double number) {
  require(sqlite3_bind_double(handle_, parameter + 1, number));
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(handle_);
  if (code == SQLITE_ROW) return true;
  const std::string why = code == SQLITE_DONE ? "" : sqlite3_errmsg(database_);
  sqlite3_reset(handle_);
  if (code != SQLITE_DONE) fail(code, why);
  return false;
}

void Statement::run() {
  while (step()) {
  }
}

std::string Statement::text(int column) const {
  const unsigned char* bytes = sqlite3_column_text(handle_, column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(handle_, column));
  if (bytes == nullptr && sqlite3_errcode(database_) == SQLITE_NOMEM) throw std::bad_alloc();
  return bytes == nullptr ? "" : std::string(reinterpret_cast<const char*>(bytes), size);
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(handle_, column); }

double Statement::real(int column) const { return sqlite3_column_double(handle_, column); }

Transaction::Transaction(Database& database) : database_(database) {
  database_.execute("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (open_) sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  database_.execute("COMMIT");
  open_ = false;
}

}  // namespace lightproof::sqlite
