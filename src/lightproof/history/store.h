// The history as a file: an SQLite database of runs and their measurements.
//
// One transaction a run, with a write-ahead log: a writer that dies leaves every run that it
// reported and no part of another, and readers see whole runs only. A history comes into being
// complete, under its final name, so that a file that is none is told from its first bytes and
// never touched.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lightproof/history/run.h"

namespace lightproof {

/// A history that is open.
class HistoryStore {
 public:
  /// Opens the history in a file for reading. Throws InputError, which names the file, if there is
  /// none, or if the file is something else, of another version, damaged or not accessible.
  static HistoryStore open_to_read(const std::filesystem::path& file);
  /// Opens the history in a file for reading and writing; makes an empty one where nothing is.
  /// Throws InputError, which names the file, if it is something else, of another version, damaged
  /// or not accessible.
  static HistoryStore open_to_write(const std::filesystem::path& file);

  ~HistoryStore();
  HistoryStore(HistoryStore&& other) noexcept;
  HistoryStore& operator=(HistoryStore&&) = delete;
  HistoryStore(const HistoryStore&) = delete;
  HistoryStore& operator=(const HistoryStore&) = delete;

  /// Adds a run, which is on the disk once this returns. Returns the run's number; none if a run of
  /// the same file (digest) is there already.
  std::optional<std::int64_t> add(const BenchmarkRun& run);

  /// Every run, the earliest first.
  std::vector<BenchmarkRun> runs() const;

 private:
  struct Connection;
  HistoryStore(std::filesystem::path file, bool writable);

  std::filesystem::path file_;
  std::unique_ptr<Connection> connection_;
};

}  // namespace lightproof
