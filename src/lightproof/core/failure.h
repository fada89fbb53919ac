// What a program says, and ends with, when an exception ends it.
#pragma once

#include <exception>
#include <string>

namespace lightproof {

/// Exit codes of a program that failed. The last two are those of sysexits.h.
enum FailureCode : int {
  kInputFailed = 2,     ///< the user's input cannot be used
  kProgramFailed = 70,  ///< a fault of the program itself (EX_SOFTWARE)
  kMemoryFailed = 71,   ///< the system has not enough memory (EX_OSERR)
};

/// What a program says and ends with when it fails.
struct Failure {
  FailureCode code;
  std::string message;  ///< one line, or more where the fault should be reported
};

/// The failure that an exception amounts to: InputError is the user's, OutOfMemory and
/// std::bad_alloc the system's; whatever else was thrown is a fault of the program, and the message
/// asks for a report and says what belongs into it.
Failure failure_of(const std::exception_ptr& error);

}  // namespace lightproof
