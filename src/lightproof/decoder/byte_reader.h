// The bytes of the file, one after the other, with their place.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lightproof {

class ByteReader {
 public:
  /// Reads a descriptor from its first byte on. Throws InputError if the system cannot.
  explicit ByteReader(int descriptor);

  /// The next byte; none at the end of the file.
  std::optional<std::uint8_t> next() {
    if (at_ == block_.size() && !fill()) return std::nullopt;
    return block_[at_++];
  }
  /// Fills the span. False, with the rest of the file passed over, if that is shorter.
  bool read(std::span<std::uint8_t> bytes);

  /// Position in the file of the byte that comes next, counted from 0.
  std::uint64_t position() const { return start_ + at_; }
  /// Goes on from there; behind the end there is nothing.
  void seek(std::uint64_t position);
  /// Bytes of the whole file.
  std::uint64_t size() const { return size_; }

 private:
  /// The next block; false at the end. Throws InputError if the system cannot read it.
  bool fill();

  int descriptor_;
  std::uint64_t size_ = 0;
  std::vector<std::uint8_t> block_;
  std::size_t at_ = 0;
  std::uint64_t start_ = 0;  ///< offset of the block in the file
};

}  // namespace lightproof
