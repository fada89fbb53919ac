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

class HistoryStore {
 public:
  /// The history in the file. Throws InputError, which names the file, if there is none, or if the
  /// file is something else, of another version, damaged or not accessible.
  static HistoryStore open_to_read(const std::filesystem::path& file);
  /// The same for writing; makes an empty history where nothing is.
  static HistoryStore open_to_write(const std::filesystem::path& file);

  ~HistoryStore();
  HistoryStore(HistoryStore&& other) noexcept;
  HistoryStore& operator=(HistoryStore&&) = delete;
  HistoryStore(const HistoryStore&) = delete;
  HistoryStore& operator=(const HistoryStore&) = delete;

  /// The number of the new run; none if a run of the same file (digest) is there already. On the
  /// disk once it returns.
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
