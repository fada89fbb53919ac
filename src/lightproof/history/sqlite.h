// SQLite with C++'s lifetimes: connections and statements that close themselves, errors that are
// thrown.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace lightproof::sqlite {

/// An error that SQLite reports, in its words.
class Error : public std::runtime_error {
 public:
  Error(int code, const std::string& message);
  /// Whether the file is at fault, and not the access to it.
  bool damaged() const { return damaged_; }

 private:
  bool damaged_ = false;
};

/// Whether a file must exist or is made.
enum class Mode { existing, create };

/// A connection to a database. Other processes may hold others to the same file: whoever finds it
/// locked waits.
class Database {
 public:
  Database(const std::filesystem::path& file, Mode mode);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  /// Takes over a connection, and leaves the other one without.
  Database(Database&& other) noexcept;
  Database& operator=(Database&&) = delete;

  /// Runs one or more statements without parameters or results.
  void execute(const char* statements);
  /// The number of the row that was inserted last.
  std::int64_t last_row() const;
  sqlite3* handle() const { return handle_; }

 private:
  sqlite3* handle_ = nullptr;
};

/// A compiled statement; parameters and columns count from 0.
class Statement {
 public:
  Statement(Database& database, const char* text);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(int parameter, std::string_view text);
  Statement& bind(int parameter, std::int64_t number);
  Statement& bind(int parameter, double number);

  /// Goes to the next row; false at the end, after which the statement may be run again.
  bool step();
  /// Runs a statement without results.
  void run();

  std::string text(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;

 private:
  void require(int code) const;

  sqlite3* database_ = nullptr;
  sqlite3_stmt* handle_ = nullptr;
};

/// A transaction, all or nothing: what was not committed is rolled back. Takes the lock for writing
/// at once, so that two writers wait for each other rather than fail.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace lightproof::sqlite
