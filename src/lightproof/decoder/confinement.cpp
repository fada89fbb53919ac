#include "lightproof/decoder/confinement.h"

#include <malloc.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <ctime>
#include <thread>
#include <vector>

#include "lightproof/core/seccomp_filter.h"

namespace lightproof {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
/// Sanitizers reserve terabytes of addresses, and read files of the system.
constexpr bool kIsConfined = false;
#else
constexpr bool kIsConfined = true;
#endif

constexpr int kFirstForeign = 4;
constexpr std::size_t kStackOfThread = std::size_t{1} << 20U;
constexpr int kMostThreads = 16;

/// What reading a descriptor, computing in threads and writing to a socket take.
constexpr long kAllowed[] = {
    SYS_read,
    SYS_write,
    SYS_pread64,
    SYS_lseek,
    SYS_futex,
    SYS_mmap,
    SYS_munmap,
    SYS_mremap,
    SYS_mprotect,
    SYS_madvise,
    SYS_brk,
    SYS_clone,
    SYS_clone3,
    SYS_set_robust_list,
    SYS_rseq,
    SYS_rt_sigaction,
    SYS_rt_sigreturn,
    SYS_rt_sigprocmask,
    SYS_sched_yield,
    SYS_exit,
    SYS_exit_group,
    SYS_clock_gettime,
    SYS_clock_nanosleep,
    SYS_nanosleep,
    SYS_gettid,
    SYS_getpid,
    SYS_tgkill,
    SYS_getrandom,
    SYS_sched_getaffinity,
    SYS_restart_syscall,
    SYS_close,
    SYS_getrusage,
};

/// Every call that is not allowed fails as if this program had no right to it. Another calling
/// convention than that of the machine ends the program.
std::vector<sock_filter> filter() {
  std::vector<sock_filter> program = {
      filter_statement(kFilterLoad, offsetof(seccomp_data, arch)),
      filter_jump(kFilterIfEqual, kSeccompArchitecture, 1, 0),
      filter_statement(kFilterReturn, SECCOMP_RET_KILL_PROCESS),
      filter_statement(kFilterLoad, offsetof(seccomp_data, nr)),
  };
  for (const long call : kAllowed) {
    program.push_back(filter_jump(kFilterIfEqual, static_cast<unsigned>(call), 0, 1));
    program.push_back(filter_statement(kFilterReturn, SECCOMP_RET_ALLOW));
  }
  // Limits of this process alone.
  program.push_back(filter_jump(kFilterIfEqual, SYS_prlimit64, 0, 3));
  program.push_back(filter_statement(kFilterLoad, offsetof(seccomp_data, args)));
  program.push_back(filter_jump(kFilterIfEqual, 0, 0, 1));
  program.push_back(filter_statement(kFilterReturn, SECCOMP_RET_ALLOW));
  program.push_back(filter_statement(kFilterReturn, SECCOMP_RET_ERRNO | EPERM));
  return program;
}

}  // namespace

void confine() {
  ::close_range(kFirstForeign, ~0U, 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) ::signal(signal, SIG_IGN);
  ::signal(SIGPIPE, SIG_DFL);
  // Stacks count as memory, and every thread would have a heap.
  pthread_attr_t attributes;
  if (::pthread_attr_init(&attributes) == 0) {
    ::pthread_attr_setstacksize(&attributes, kStackOfThread);
    ::pthread_setattr_default_np(&attributes);
    ::pthread_attr_destroy(&attributes);
  }
  ::mallopt(M_ARENA_MAX, 2);
  limit_resource(RLIMIT_CORE, 0, true);
  if (!kIsConfined) return;
  limit_resource(RLIMIT_FSIZE, 0, true);
  // Where the system has no filters, the limits remain.
  install_filter(filter());
}

void limit(std::uint64_t bytes, double seconds) {
  if (!kIsConfined) return;
  limit_resource(RLIMIT_DATA, bytes);
  limit_resource(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(seconds)));
}

double seconds_taken() {
  timespec now = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

int threads_to_use() {
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads);
}

}  // namespace lightproof
