#include "lightproof/core/companion_start.h"

#include <fmt/format.h>
#include <sys/socket.h>

#include <cstdio>
#include <string_view>

#include "lightproof/core/failure.h"

namespace lightproof {

bool is_socket(int descriptor) {
  int type = 0;
  socklen_t size = sizeof type;
  return ::getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) == 0;
}

int explain_companion(const char* name, const char* usage, int argc, char** argv) {
  const std::string_view word = argc > 1 ? argv[1] : "";
  if (word == "--version") {
    fmt::print("{} {}\n", name, LIGHTPROOF_VERSION);
    return 0;
  }
  fmt::print(word == "--help" ? stdout : stderr, "{}", usage);
  return word == "--help" ? 0 : kInputFailed;
}

}  // namespace lightproof
