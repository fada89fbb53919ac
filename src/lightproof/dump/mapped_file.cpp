#include "lightproof/dump/mapped_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

/// Closes a file that was opened; the mapping of its bytes stays.
class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& file)
      : number_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~OpenFile() {
    if (number_ >= 0) ::close(number_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int number() const { return number_; }

 private:
  int number_;
};

[[noreturn]] void refuse_to_read(const std::filesystem::path& file, std::string_view reason) {
  throw InputError(fmt::format("{}: {}", file.string(), reason));
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& file) {
  const OpenFile open(file);
  struct stat status = {};
  if (open.number() < 0 || ::fstat(open.number(), &status) != 0) {
    refuse_to_read(file, std::strerror(errno));
  }
  if (S_ISDIR(status.st_mode)) refuse_to_read(file, "is a folder, a file of samples is needed");
  if (!S_ISREG(status.st_mode)) {
    refuse_to_read(file, "is no regular file; a pipe is read as the standard input, \"-\"");
  }
  size_ = static_cast<std::size_t>(status.st_size);
  if (size_ == 0) return;
  void* const mapped = ::mmap(nullptr, size_, PROT_READ, MAP_SHARED, open.number(), 0);
  if (mapped == MAP_FAILED) refuse_to_read(file, std::strerror(errno));
  data_ = static_cast<const std::byte*>(mapped);
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) ::munmap(const_cast<std::byte*>(data_), size_);
}

void MappedFile::forget(std::size_t first, std::size_t count) const {
  if (data_ == nullptr) return;
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::size_t begin = (first + page - 1) / page * page;
  const std::size_t end = std::min(first + count, size_) / page * page;
  if (begin < end) ::madvise(const_cast<std::byte*>(data_) + begin, end - begin, MADV_DONTNEED);
}

}  // namespace lightproof
