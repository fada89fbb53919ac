// Bad input is an exception that names the file, the place, the reason and what would help.
#pragma once

#include <stdexcept>
#include <string>

namespace lightproof {

/// The user's input cannot be used (exit code 2). The message is complete: it is shown as it is.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The system has not enough memory for what was asked (exit code 71). The message is complete; see
/// out_of_memory.h.
class OutOfMemory : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The user pressed Ctrl-C, or the system asks the program to end (exit code 128 and the signal).
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace lightproof
