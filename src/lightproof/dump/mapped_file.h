// A file's bytes as memory: of a file of any size no more is held than what is being read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace lightproof {

/// A file that is mapped for reading. Its bytes may be read by many threads. If another program
/// makes the file shorter meanwhile, the one that reads it ends with exit code 2 and a message that
/// names the file; of more than 16 that are mapped at once, of the first 16.
class MappedFile {
 public:
  /// Throws InputError if the file cannot be read, or is no regular file.
  explicit MappedFile(const std::filesystem::path& file);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::byte> bytes() const { return {data_, size_}; }

  /// Lets the system forget the pages of these bytes, up to the last whole one, which are read
  /// again from the file if they are needed again.
  void forget(std::size_t first, std::size_t count) const;

 private:
  const std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace lightproof
