#include "lightproof/plugin_host/confinement.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <thread>
#include <vector>

#include "lightproof/core/seccomp_filter.h"
#include "lightproof/core/system_call.h"
#include "lightproof/plugin/plugin_messages.h"

namespace lightproof {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
/// Sanitizers reserve terabytes of addresses.
constexpr bool kLimitsMemory = false;
#else
constexpr bool kLimitsMemory = true;
#endif

constexpr int kOutOfTheWay = 10;
constexpr std::size_t kDroppedAtOnce = std::size_t{16} << 10U;
/// What the plug-in has to free what is its own, once nobody asks any more.
constexpr std::chrono::milliseconds kGrace{400};

/// Calls with this bit belong to another convention (x32).
#if defined(__x86_64__)
constexpr unsigned kOtherConvention = 0x40000000U;
#else
constexpr unsigned kOtherConvention = 0;
#endif

/// Calls that start a process or another program. Threads are clone() with CLONE_THREAD.
constexpr long kEnding[] = {
#ifdef SYS_fork
    SYS_fork,
#endif
#ifdef SYS_vfork
    SYS_vfork,
#endif
    SYS_execve,
    SYS_execveat,
};

/// Everything is allowed but new processes and programs. The flags of clone3() cannot be seen:
/// where it is said not to exist, libraries take clone().
std::vector<sock_filter> filter() {
  std::vector<sock_filter> program = {
      filter_statement(kFilterLoad, offsetof(seccomp_data, arch)),
      filter_jump(kFilterIfEqual, kSeccompArchitecture, 1, 0),
      filter_statement(kFilterReturn, SECCOMP_RET_KILL_PROCESS),
      filter_statement(kFilterLoad, offsetof(seccomp_data, nr)),
      filter_jump(kFilterIfEqual, SYS_clone3, 0, 1),
      filter_statement(kFilterReturn, SECCOMP_RET_ERRNO | ENOSYS),
  };
  if (kOtherConvention != 0) {
    program.push_back(filter_jump(kFilterIfAny, kOtherConvention, 0, 1));
    program.push_back(filter_statement(kFilterReturn, SECCOMP_RET_KILL_PROCESS));
  }
  for (const long call : kEnding) {
    program.push_back(filter_jump(kFilterIfEqual, static_cast<unsigned>(call), 0, 1));
    program.push_back(filter_statement(kFilterReturn, SECCOMP_RET_KILL_PROCESS));
  }
  program.push_back(filter_jump(kFilterIfEqual, SYS_clone, 0, 3));
  // The flags are the first argument; its lower half comes first.
  program.push_back(filter_statement(kFilterLoad, offsetof(seccomp_data, args)));
  program.push_back(filter_jump(kFilterIfAny, CLONE_THREAD, 1, 0));
  program.push_back(filter_statement(kFilterReturn, SECCOMP_RET_KILL_PROCESS));
  program.push_back(filter_statement(kFilterReturn, SECCOMP_RET_ALLOW));
  return program;
}

/// Takes what is there to be read into the free part of the log, or drops it. Read right into the
/// log: a crash of another thread loses nothing of it.
std::span<std::byte> taken(int prints, std::span<std::byte> log) {
  std::array<std::byte, kDroppedAtOnce> dropped;
  const std::span<std::byte> into = log.empty() ? std::span<std::byte>(dropped) : log;
  const ssize_t got = uninterrupted([&] { return ::read(prints, into.data(), into.size()); });
  return got <= 0 || log.empty() ? log : log.subspan(static_cast<std::size_t>(got));
}

using Clock = std::chrono::steady_clock;

/// At least 0, rounded up.
int milliseconds_until(Clock::time_point time) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(time - Clock::now());
  return static_cast<int>(std::max<std::int64_t>(left.count(), 0));
}

/// Takes what is printed until the socket is closed, and for a moment after that.
void take_prints(const HostFiles& files, std::span<std::byte> log) {
  std::array<pollfd, 2> watched = {{{.fd = files.socket, .events = POLLRDHUP, .revents = 0},
                                    {.fd = files.prints, .events = POLLIN, .revents = 0}}};
  std::optional<Clock::time_point> end;
  while (!end || Clock::now() < *end) {
    if (::poll(watched.data(), watched.size(), end ? milliseconds_until(*end) : -1) <= 0) continue;
    if (watched[0].revents != 0) {
      end = Clock::now() + kGrace;
      watched[0].fd = -1;
    }
    if ((watched[1].revents & POLLIN) != 0) {
      log = taken(files.prints, log);
    } else if (watched[1].revents != 0) {
      // Nobody can print any more.
      watched[1].fd = -1;
    }
  }
}

}  // namespace

HostFiles confine_plugin() {
  ::setpgid(0, 0);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  const HostFiles files = {.socket = ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, kOutOfTheWay),
                           .prints = ::fcntl(kPluginPrintsEnd, F_DUPFD_CLOEXEC, kOutOfTheWay)};
  ::close(STDIN_FILENO);
  ::open("/dev/null", O_RDONLY);  // takes the number of the standard input
  ::dup2(kPluginPrintEnd, STDOUT_FILENO);
  ::dup2(kPluginPrintEnd, STDERR_FILENO);
  ::close(kPluginPrintsEnd);
  ::close(kPluginPrintEnd);
  // A crash must not take with it what was printed before.
  std::setvbuf(stdout, nullptr, _IONBF, 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE}) ::signal(signal, SIG_IGN);
  // Whoever asks sees how it crashes: nobody else catches that here, no sanitizer either.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) ::signal(signal, SIG_DFL);
  limit_resource(RLIMIT_CORE, 0);
  return files;
}

void watch(const HostFiles& files, std::span<std::byte> log) {
  std::thread([files, log] {
    take_prints(files, log);
    ::_exit(kPluginStuck);
  }).detach();
  // Where the system has no filters, has_children() sees the process afterwards.
  install_filter(filter());
}

void limit_memory(std::uint64_t bytes) {
  if (kLimitsMemory && bytes > 0) limit_resource(RLIMIT_DATA, bytes);
}

std::uint64_t held_memory() {
  static const int statm = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  static const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  char text[128] = {};
  if (statm < 0 || ::pread(statm, text, sizeof text - 1, 0) <= 0) return 0;
  // Size, resident, shared; strtoull() gives 0 where there is no number.
  char* at = text;
  static_cast<void>(std::strtoull(at, &at, 10));
  const std::uint64_t resident = std::strtoull(at, &at, 10);
  const std::uint64_t shared = std::strtoull(at, &at, 10);
  return page * (resident - std::min(resident, shared));
}

bool has_children() { return ::waitpid(-1, nullptr, WNOHANG | __WALL) >= 0; }

}  // namespace lightproof
