// What the targets share: bytes as choices and numbers, files in memory, and failing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "lightproof/core/error.h"

namespace lightproof::fuzz {

/// The input, taken apart from its front. Behind its end there are zeros.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : bytes_(data, size) {}

  template <class Number>
  Number take() {
    std::array<std::uint8_t, sizeof(Number)> bytes{};
    const std::size_t count = std::min(bytes.size(), bytes_.size());
    std::memcpy(bytes.data(), bytes_.data(), count);
    bytes_ = bytes_.subspan(count);
    Number number;
    std::memcpy(&number, bytes.data(), sizeof number);
    return number;
  }
  /// 0 to count - 1, of one byte.
  std::size_t below(std::size_t count) { return take<std::uint8_t>() % count; }
  bool is_empty() const { return bytes_.empty(); }
  /// What was not taken.
  std::span<const std::uint8_t> rest() const { return bytes_; }
  std::string_view text() const {
    return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()};
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

/// A file that is nowhere but in memory.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  /// A name under which this process finds it.
  std::filesystem::path path() const;

 private:
  int descriptor_;
};

/// Reports what is wrong and ends the process, for libFuzzer to keep the input.
[[noreturn]] void fail(std::string_view what);

/// Fails unless a refusal says something, in one line.
void require_words(const std::string& refusal);

/// Runs `work`, which may refuse its input by InputError, or say what needs too much memory, in
/// words, and throw nothing else. Returns whether it accepted it.
template <class Work>
bool accepts(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    require_words(error.what());
    return false;
  } catch (const OutOfMemory& error) {
    require_words(error.what());
    return false;
  }
  return true;
}

/// From now on one allocation of so many bytes at most succeeds, by which targets have less memory
/// than a file may claim: beyond it there is std::bad_alloc.
void limit_allocations(std::size_t bytes);

}  // namespace lightproof::fuzz
