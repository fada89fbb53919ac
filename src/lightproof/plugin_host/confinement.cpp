#include "lightproof/plugin_host/confinement.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
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

constexpr int kSocket = 10;
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

}  // namespace

int confine_plugin() {
  ::setpgid(0, 0);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  const int socket = ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, kSocket);
  ::close(STDIN_FILENO);
  ::open("/dev/null", O_RDONLY);  // takes the number of the standard input
  ::dup2(kPluginLogFile, STDOUT_FILENO);
  ::dup2(kPluginLogFile, STDERR_FILENO);
  // A crash must not take with it what was printed before.
  std::setvbuf(stdout, nullptr, _IONBF, 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE}) ::signal(signal, SIG_IGN);
  // Whoever asks sees how it crashes: nobody else catches that here, no sanitizer either.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) ::signal(signal, SIG_DFL);
  limit_resource(RLIMIT_CORE, 0);
  return socket;
}

void end_with(int socket) {
  std::thread([socket] {
    pollfd end = {.fd = socket, .events = POLLRDHUP, .revents = 0};
    while (uninterrupted([&] { return ::poll(&end, 1, -1); }) <= 0) {
    }
    std::this_thread::sleep_for(kGrace);
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
