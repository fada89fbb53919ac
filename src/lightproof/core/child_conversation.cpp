#include "lightproof/core/child_conversation.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/spawn.h"
#include "lightproof/core/system_call.h"

namespace lightproof {
namespace fs = std::filesystem;
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

/// How long an interrupt may go unnoticed.
constexpr milliseconds kAttention{50};
/// The time that a program has to end after its socket was closed.
constexpr milliseconds kGrace{500};
/// Descriptors of the child: standard ones, then the files.
constexpr int kFirstFile = 3;
/// The least descriptor of this process that is out of the way of those of the child.
constexpr int kOutOfTheWay = 10;
constexpr std::size_t kMostFiles = kOutOfTheWay - kFirstFile;
constexpr const char* kNowhere = "/dev/null";
constexpr int kSocketBuffer = 1 << 20;

[[noreturn]] void fail(const fs::path& program, int error) {
  throw InputError(fmt::format("{}: cannot be started: {}", program.string(),
                               std::generic_category().message(error)));
}

/// A descriptor of this process alone, closed with this.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  Descriptor(Descriptor&& other) noexcept : descriptor_(other.release()) {}
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;

  int get() const { return descriptor_; }
  int release() { return std::exchange(descriptor_, -1); }

 private:
  int descriptor_;
};

/// A descriptor of the same file, under a number that no redirection of the child overwrites.
int moved_away(const fs::path& program, int descriptor) {
  const int moved = ::fcntl(descriptor, F_DUPFD_CLOEXEC, kOutOfTheWay);
  if (moved < 0) fail(program, errno);
  return moved;
}

pid_t start(const fs::path& program, const std::vector<std::string>& arguments, int socket,
            const std::vector<Descriptor>& files) {
  Redirections redirections;
  redirections.duplicate(socket, STDIN_FILENO);
  redirections.duplicate(socket, STDOUT_FILENO);
  // A bare root has no devices: words that nobody reads may as well fail.
  if (::access(kNowhere, W_OK) == 0) {
    redirections.open(STDERR_FILENO, kNowhere, O_WRONLY);
  } else {
    redirections.close(STDERR_FILENO);
  }
  int theirs = kFirstFile;
  for (const Descriptor& file : files) redirections.duplicate(file.get(), theirs++);
  return spawn(program, arguments, redirections);
}

}  // namespace

ChildConversation::ChildConversation(const fs::path& program,
                                     const std::vector<std::string>& arguments, int file,
                                     milliseconds patience)
    : ChildConversation(program, arguments, std::span(&file, file < 0 ? 0 : 1), patience) {}

ChildConversation::ChildConversation(const fs::path& program,
                                     const std::vector<std::string>& arguments,
                                     std::span<const int> files, milliseconds patience)
    : patience_(patience) {
  if (files.size() > kMostFiles) throw std::length_error("too many files for a child");
  int ends[2] = {-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail(program, errno);
  const Descriptor low_ours(ends[0]);
  const Descriptor low_theirs(ends[1]);
  Descriptor ours(moved_away(program, ends[0]));
  const Descriptor theirs(moved_away(program, ends[1]));
  std::vector<Descriptor> handed_over;
  for (const int file : files) handed_over.emplace_back(moved_away(program, file));
  // As much as the system allows at once: a picture passes in fewer pieces.
  for (const int end : ends) {
    ::setsockopt(end, SOL_SOCKET, SO_SNDBUF, &kSocketBuffer, sizeof kSocketBuffer);
  }
  child_ = start(program, arguments, theirs.get(), handed_over);
  socket_ = ours.release();
}

ChildConversation::~ChildConversation() {
  if (socket_ >= 0) ::close(socket_);
  if (child_ < 0) return;
  ::kill(child_, SIGKILL);
  uninterrupted([&] { return ::waitpid(child_, nullptr, 0); });
}

Exchange ChildConversation::wait_for(short events) {
  const auto deadline = Clock::now() + patience_;
  for (;;) {
    throw_if_interrupted();
    pollfd ready = {.fd = socket_, .events = events, .revents = 0};
    // An error other than an interruption, like lack of memory, is tried again until patience ends.
    if (::poll(&ready, 1, static_cast<int>(kAttention.count())) > 0) return Exchange::done;
    if (Clock::now() > deadline) return Exchange::silent;
  }
}

Exchange ChildConversation::send(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = uninterrupted(
        [&] { return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT); });
    if (sent >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
    } else if (errno != EAGAIN && errno != ENOBUFS) {
      return Exchange::closed;
    } else if (wait_for(POLLOUT) == Exchange::silent) {
      return Exchange::silent;
    }
  }
  return Exchange::done;
}

Exchange ChildConversation::receive(std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t got =
        uninterrupted([&] { return ::recv(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT); });
    if (got > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(got));
    } else if (got == 0 || errno != EAGAIN) {
      return Exchange::closed;
    } else if (wait_for(POLLIN) == Exchange::silent) {
      return Exchange::silent;
    }
  }
  return Exchange::done;
}

std::optional<ChildEnd> ChildConversation::end() {
  if (socket_ >= 0) ::close(std::exchange(socket_, -1));
  const pid_t child = std::exchange(child_, -1);
  const auto deadline = Clock::now() + kGrace;
  int status = 0;
  rusage used = {};
  for (milliseconds pause{1};; pause = std::min(2 * pause, kAttention)) {
    const pid_t ended = uninterrupted([&] { return ::wait4(child, &status, WNOHANG, &used); });
    if (ended == child) break;
    if (ended < 0) return std::nullopt;
    if (Clock::now() > deadline) ::kill(child, SIGKILL);
    std::this_thread::sleep_for(pause);
  }
  const std::uint64_t peak = std::uint64_t{1024} * static_cast<std::uint64_t>(used.ru_maxrss);
  if (WIFSIGNALED(status)) return ChildEnd{true, WTERMSIG(status), peak};
  return ChildEnd{false, WEXITSTATUS(status), peak};
}

}  // namespace lightproof
