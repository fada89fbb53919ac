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

/// What SQLite reports, in its words.
class Error : public std::runtime_error {
 public:
  Error(int code, const std::string& message);
  /// The file is at fault, and not its access.
  bool damaged() const { return damaged_; }

 private:
  bool damaged_ = false;
};

enum class Mode { existing, create };

/// A connection. Other processes may hold others to the same file: whoever finds it locked waits.
class Database {
 public:
  Database(const std::filesystem::path& file, Mode mode);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  /// Leaves the other one without a connection.
  Database(Database&& other) noexcept;
  Database& operator=(Database&&) = delete;

  /// One or more statements without parameters or results.
  void execute(const char* statements);
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

  /// To the next row; false at the end, after which the statement may be run again.
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

/// All or nothing: what was not committed is rolled back. Takes the lock for writing at once, so
/// that two writers wait for each other rather than fail.
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
