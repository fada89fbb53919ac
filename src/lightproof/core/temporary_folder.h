// A folder for what only this process needs.
#pragma once

#include <filesystem>
#include <string_view>

namespace lightproof {

/// A new folder among the system's temporary ones, which goes away with what is in it.
class TemporaryFolder {
 public:
  /// Throws InputError if none can be made.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace lightproof
