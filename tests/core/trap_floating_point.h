// What no correct method computes: NaN, infinities, overflow. Traps of the processor end the test
// where one arises, though nothing that comes out may show it.
#pragma once

#include <execinfo.h>
#include <unistd.h>

#include <array>
#include <cfenv>
#include <csignal>
#include <cstring>

namespace lightproof::test {

/// While it lives, an operation that gives NaN (of numbers), an infinity or an overflow ends the
/// program by SIGFPE, with the calls that led to it, on this thread and in the tasks of parallel
/// loops. Conversions of numbers that an integer cannot hold and comparisons with NaN count. Does
/// nothing where the processor or the C library has no such traps.
class TrapFloatingPoint {
 public:
  TrapFloatingPoint() {
    struct sigaction action = {};
    action.sa_sigaction = report;
    action.sa_flags = SA_SIGINFO | static_cast<int>(SA_RESETHAND);
    ::sigaction(SIGFPE, &action, &before_);
    std::feclearexcept(FE_ALL_EXCEPT);
    ::feenableexcept(kTrapped);
  }
  ~TrapFloatingPoint() {
    ::fedisableexcept(kTrapped);
    std::feclearexcept(FE_ALL_EXCEPT);
    ::sigaction(SIGFPE, &before_, nullptr);
  }
  TrapFloatingPoint(const TrapFloatingPoint&) = delete;
  TrapFloatingPoint& operator=(const TrapFloatingPoint&) = delete;

 private:
  static constexpr int kTrapped = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;

  static void write(const char* text) {
    static_cast<void>(::write(STDERR_FILENO, text, std::strlen(text)) < 0);
  }
  /// The operation is tried again afterwards, and ends the program.
  static void report(int /*signal*/, siginfo_t* info, void* /*context*/) {
    write("a trapped operation: ");
    write(info->si_code == FPE_FLTDIV   ? "division by zero"
          : info->si_code == FPE_FLTOVF ? "overflow"
                                        : "not a number, or none that an integer can hold");
    write("\n");
    std::array<void*, 64> calls{};
    ::backtrace_symbols_fd(calls.data(), ::backtrace(calls.data(), static_cast<int>(calls.size())),
                           STDERR_FILENO);
  }

  struct sigaction before_ = {};
};

}  // namespace lightproof::test
