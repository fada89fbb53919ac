#include "lightproof/image/byte_reader.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "lightproof/image/file_format.h"

namespace lightproof {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 18U;

}  // namespace

ByteReader::ByteReader(const std::filesystem::path& file)
    : file_(file), stream_(file, std::ios::binary) {
  if (!stream_) refuse(file_, std::generic_category().message(errno));
  size_ = std::filesystem::file_size(file_);
}

bool ByteReader::fill() {
  start_ += block_.size();
  at_ = 0;
  block_.resize(kBlock);
  errno = 0;
  stream_.read(reinterpret_cast<char*>(block_.data()), static_cast<std::streamsize>(kBlock));
  if (stream_.bad()) refuse(file_, "cannot be read: " + std::generic_category().message(errno));
  block_.resize(static_cast<std::size_t>(stream_.gcount()));
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

}  // namespace lightproof
