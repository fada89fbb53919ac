#include "lightproof/decoder/confinement.h"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <malloc.h>
#include <pthread.h>
#include <sys/prctl.h>
#include <sys/resource.h>
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

#if defined(__x86_64__)
constexpr unsigned kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr unsigned kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr unsigned kArchitecture = 0;
#endif

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

sock_filter statement(unsigned code, unsigned value) {
  return {static_cast<unsigned short>(code), 0, 0, value};
}

sock_filter jump(unsigned code, unsigned value, unsigned if_true, unsigned if_false) {
  return {static_cast<unsigned short>(code), static_cast<unsigned char>(if_true),
          static_cast<unsigned char>(if_false), value};
}

constexpr unsigned kLoad = BPF_LD | BPF_W | BPF_ABS;
constexpr unsigned kIfEqual = BPF_JMP | BPF_JEQ | BPF_K;

/// Every call that is not allowed fails as if this program had no right to it. Another calling
/// convention than that of the machine ends the program.
std::vector<sock_filter> filter() {
  std::vector<sock_filter> program = {
      statement(kLoad, offsetof(seccomp_data, arch)),
      jump(kIfEqual, kArchitecture, 1, 0),
      statement(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
      statement(kLoad, offsetof(seccomp_data, nr)),
  };
  for (const long call : kAllowed) {
    program.push_back(jump(kIfEqual, static_cast<unsigned>(call), 0, 1));
    program.push_back(statement(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  }
  // Limits of this process alone.
  program.push_back(jump(kIfEqual, SYS_prlimit64, 0, 3));
  program.push_back(statement(kLoad, offsetof(seccomp_data, args)));
  program.push_back(jump(kIfEqual, 0, 0, 1));
  program.push_back(statement(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  program.push_back(statement(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM));
  return program;
}

void install_filter() {
  if (kArchitecture == 0) return;
  std::vector<sock_filter> program = filter();
  const sock_fprog whole = {static_cast<unsigned short>(program.size()), program.data()};
  // Where the system has no filters, the limits remain.
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &whole);
}

/// No more than is allowed already.
void set_limit(__rlimit_resource resource, rlim_t value, bool for_good) {
  rlimit now = {};
  if (::getrlimit(resource, &now) != 0) return;
  now.rlim_cur = std::min(value, now.rlim_max);
  if (for_good) now.rlim_max = now.rlim_cur;
  ::setrlimit(resource, &now);
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
  set_limit(RLIMIT_CORE, 0, true);
  if (!kIsConfined) return;
  set_limit(RLIMIT_FSIZE, 0, true);
  install_filter();
}

void limit(std::uint64_t bytes, double seconds) {
  if (!kIsConfined) return;
  set_limit(RLIMIT_DATA, bytes, false);
  set_limit(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(seconds)), false);
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
