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

/// A file that is mapped now, for a signal handler: one that became shorter while it is read ends
/// the program (SIGBUS), with a message of the file instead of none.
struct Mapped {
  std::atomic<bool> is_taken = false;
  std::atomic<const std::byte*> begin = nullptr;  ///< set last; null while the others change
  std::atomic<std::size_t> size = 0;
  std::array<char, 4096> message = {};
  std::atomic<std::size_t> length = 0;

  bool holds(const std::byte* at) const {
    const std::byte* const first = begin;
    return first != nullptr && std::greater_equal<>()(at, first) && std::less<>()(at, first + size);
  }
};
/// More than a command maps at once.
std::array<Mapped, 16> mapped_now;

void on_missing_page(int signal, siginfo_t* info, void* /*context*/) {
  const auto* const at = static_cast<const std::byte*>(info->si_addr);
  for (const Mapped& mapped : mapped_now) {
    if (!mapped.holds(at)) continue;
    const ssize_t written = ::write(STDERR_FILENO, mapped.message.data(), mapped.length);
    static_cast<void>(written);
    ::_exit(kInputFailed);
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void name_missing_pages_of(const std::filesystem::path& file, const std::byte* data,
                           std::size_t size) {
  const auto free = std::ranges::find_if(
      mapped_now, [](Mapped& mapped) { return !mapped.is_taken.exchange(true); });
  if (free == mapped_now.end()) return;
  const std::string text =
      terminal_text(
          fmt::format("lightproof: {}: has become shorter while it was read", file.string())) +
      "\n";
  free->length = text.copy(free->message.data(), free->message.size());
  free->size = size;
  free->begin = data;
  struct sigaction action = {};
  action.sa_sigaction = on_missing_page;
  action.sa_flags = SA_SIGINFO;
  ::sigaction(SIGBUS, &action, nullptr);
}

void forget_missing_pages_of(const std::byte* data) {
  for (Mapped& mapped : mapped_now) {
    if (mapped.begin != data) continue;
    mapped.begin = nullptr;
    mapped.is_taken = false;
    return;
  }
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
  forget_missing_pages_of(data_);
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
