// Results of cells of work in a file that grows, a record each.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace lightproof {

/// Bytes by keys. A record is appended as a whole, so that a process that is killed at any moment
/// loses the record that it was writing, and no other; what was damaged since, and all behind it,
/// is dropped. Many threads may ask and add.
class CellLog {
 public:
  /// Reads what the file holds. Throws InputError if it cannot be opened, made or read.
  explicit CellLog(std::filesystem::path file);
  ~CellLog();
  CellLog(const CellLog&) = delete;
  CellLog& operator=(const CellLog&) = delete;

  std::optional<std::string> find(const std::string& key) const;
  /// Throws InputError if the disk is full.
  void add(const std::string& key, std::string_view bytes);

 private:
  /// Up to the last whole record; returns how many bytes these are.
  std::size_t read(std::string_view content);

  std::filesystem::path path_;
  int descriptor_ = -1;
  mutable std::mutex mutex_;
  std::map<std::string, std::string> records_;  ///< those that the file held at the beginning
};

}  // namespace lightproof
