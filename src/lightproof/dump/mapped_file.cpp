#include "lightproof/dump/mapped_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <functional>
#include <string>

#include "lightproof/core/error.h"
#include "lightproof/core/failure.h"
#include "lightproof/core/text_escapes.h"

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

/// What is mapped now, for a signal handler: a file that became shorter while it is read ends the
/// program (SIGBUS), with a message of the file instead of none.
struct Mapped {
  std::atomic<const std::byte*> begin = nullptr;
  std::atomic<std::size_t> size = 0;
  std::array<char, 4096> message = {};
  std::atomic<std::size_t> length = 0;
};
Mapped mapped_now;

void on_missing_page(int signal, siginfo_t* info, void* /*context*/) {
  const auto* const at = static_cast<const std::byte*>(info->si_addr);
  const std::byte* const begin = mapped_now.begin;
  if (begin != nullptr && std::greater_equal<>()(at, begin) &&
      std::less<>()(at, begin + mapped_now.size)) {
    const ssize_t written = ::write(STDERR_FILENO, mapped_now.message.data(), mapped_now.length);
    static_cast<void>(written);
    ::_exit(kInputFailed);
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void name_missing_pages_of(const std::filesystem::path& file, const std::byte* data,
                           std::size_t size) {
  const std::string text =
      terminal_text(
          fmt::format("lightproof: {}: has become shorter while it was read", file.string())) +
      "\n";
  mapped_now.begin = nullptr;
  mapped_now.length = text.copy(mapped_now.message.data(), mapped_now.message.size());
  mapped_now.size = size;
  mapped_now.begin = data;
  struct sigaction action = {};
  action.sa_sigaction = on_missing_page;
  action.sa_flags = SA_SIGINFO;
  ::sigaction(SIGBUS, &action, nullptr);
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
  name_missing_pages_of(file, data_, size_);
}

MappedFile::~MappedFile() {
  if (data_ == nullptr) return;
  if (mapped_now.begin == data_) mapped_now.begin = nullptr;
  ::munmap(const_cast<std::byte*>(data_), size_);
}

void MappedFile::forget(std::size_t first, std::size_t count) const {
  if (data_ == nullptr) return;
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  // The page that a block shares with the one before it is forgotten with the later one.
  const std::size_t begin = first / page * page;
  const std::size_t end = std::min(first + count, size_) / page * page;
  if (begin < end) ::madvise(const_cast<std::byte*>(data_) + begin, end - begin, MADV_DONTNEED);
}

}  // namespace lightproof
