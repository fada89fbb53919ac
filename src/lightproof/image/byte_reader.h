// The bytes of a file, one after the other, with their place. Private to the image module.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <vector>

namespace lightproof {

class ByteReader {
 public:
  /// Throws InputError if the file cannot be opened.
  explicit ByteReader(const std::filesystem::path& file);

  /// The next byte; none at the end of the file.
  std::optional<std::uint8_t> next() {
    if (at_ == block_.size() && !fill()) return std::nullopt;
    return block_[at_++];
  }
  /// Fills the span. False, with the rest of the file passed over, if that is shorter.
  bool read(std::span<std::uint8_t> bytes);

  /// Position in the file of the byte that comes next, counted from 0.
  std::uint64_t position() const { return start_ + at_; }
  /// Bytes of the whole file.
  std::uint64_t size() const { return size_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  /// The next block; false at the end. Throws InputError if the system cannot read it.
  bool fill();

  std::filesystem::path file_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
  std::vector<std::uint8_t> block_;
  std::size_t at_ = 0;
  std::uint64_t start_ = 0;  ///< place of the block in the file
};

}  // namespace lightproof
