#include "lightproof/decoder/byte_reader.h"

#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

#include "lightproof/core/system_call.h"
#include "lightproof/decoder/refusal.h"

namespace lightproof {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 17U;

[[noreturn]] void refuse_error() {
  refuse("cannot be read: " + std::generic_category().message(errno));
}

}  // namespace

ByteReader::ByteReader(int descriptor) : descriptor_(descriptor) {
  const off_t end = ::lseek(descriptor, 0, SEEK_END);
  if (end < 0) refuse_error();
  size_ = static_cast<std::uint64_t>(end);
}

bool ByteReader::fill() {
  start_ += block_.size();
  at_ = 0;
  block_.resize(kBlock);
  const ssize_t got = uninterrupted([&] {
    return ::pread(descriptor_, block_.data(), block_.size(), static_cast<off_t>(start_));
  });
  if (got < 0) refuse_error();
  block_.resize(static_cast<std::size_t>(got));
  return !block_.empty();
}

bool ByteReader::read(std::span<std::uint8_t> bytes) {
  while (!bytes.empty()) {
    if (at_ == block_.size() && !fill()) return false;
    const std::size_t count = std::min(bytes.size(), block_.size() - at_);
    std::copy_n(block_.begin() + static_cast<std::ptrdiff_t>(at_), count, bytes.begin());
    at_ += count;
    bytes = bytes.subspan(count);
  }
  return true;
}

void ByteReader::seek(std::uint64_t position) {
  if (position >= start_ && position <= start_ + block_.size()) {
    at_ = position - start_;
    return;
  }
  block_.clear();
  at_ = 0;
  start_ = std::min(position, size_);
}

}  // namespace lightproof
