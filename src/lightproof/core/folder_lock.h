// One process at a time in a folder.
#pragma once

#include <filesystem>

namespace lightproof {

/// Keeps other processes out of a folder while it lives, as far as they ask. The system ends it
/// with the process, however that ends (flock(2)); programs that are started do not inherit it.
class FolderLock {
 public:
  /// Holds nothing.
  FolderLock() = default;
  /// Throws InputError if another process is in the folder. Where the file system has no locks, or
  /// the folder is not there, it holds nothing.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Whether other processes are kept out.
  bool holds() const { return descriptor_ >= 0; }

 private:
  int descriptor_ = -1;
};

}  // namespace lightproof
