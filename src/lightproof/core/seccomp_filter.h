// What programs of Lightproof that run other people's code or read other people's files share in
// keeping to less than they may: filters of system calls, limits of resources. Linux alone.
#pragma once

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <algorithm>
#include <vector>

namespace lightproof {

/// The calling convention of this program, as filters see it; 0 where there are no filters.
#if defined(__x86_64__)
inline constexpr unsigned kSeccompArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
inline constexpr unsigned kSeccompArchitecture = AUDIT_ARCH_AARCH64;
#else
inline constexpr unsigned kSeccompArchitecture = 0;
#endif

/// Codes of filter instructions: take a word of the call, compare it, test its bits, end.
inline constexpr unsigned kFilterLoad = BPF_LD | BPF_W | BPF_ABS;
inline constexpr unsigned kFilterIfEqual = BPF_JMP | BPF_JEQ | BPF_K;
inline constexpr unsigned kFilterIfAny = BPF_JMP | BPF_JSET | BPF_K;
inline constexpr unsigned kFilterReturn = BPF_RET | BPF_K;

/// An instruction of a filter that does not jump.
inline sock_filter filter_statement(unsigned code, unsigned value) {
  return {static_cast<unsigned short>(code), 0, 0, value};
}

/// An instruction of a filter that leaves out so many of the following, by what it finds.
inline sock_filter filter_jump(unsigned code, unsigned value, unsigned if_true, unsigned if_false) {
  return {static_cast<unsigned short>(code), static_cast<unsigned char>(if_true),
          static_cast<unsigned char>(if_false), value};
}

/// Holds this process and its threads to a filter, for good. Where the system has no filters,
/// nothing happens.
inline void install_filter(std::vector<sock_filter> program) {
  if (kSeccompArchitecture == 0) return;
  const sock_fprog whole = {static_cast<unsigned short>(program.size()), program.data()};
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &whole);
}

/// Limits a resource of this process to `value`, or to what it is allowed already if that is less;
/// `for_good`: it cannot be raised again.
inline void limit_resource(__rlimit_resource resource, rlim_t value, bool for_good = false) {
  rlimit now = {};
  if (::getrlimit(resource, &now) != 0) return;
  now.rlim_cur = std::min(value, now.rlim_max);
  if (for_good) now.rlim_max = now.rlim_cur;
  ::setrlimit(resource, &now);
}

}  // namespace lightproof
