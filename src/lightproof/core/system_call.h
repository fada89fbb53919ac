// Calls of the operating system that a signal may cut short.
#pragma once

#include <cerrno>

namespace lightproof {

/// What `call` returns, repeated as long as it fails because a signal came (EINTR). Not for
/// close(), which must not be repeated: the file is closed all the same.
template <class Call>
auto uninterrupted(const Call& call) {
  auto result = call();
  while (result == -1 && errno == EINTR) result = call();
  return result;
}

}  // namespace lightproof
