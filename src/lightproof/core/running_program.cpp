#include "lightproof/core/running_program.h"

#include <bit>
#include <cerrno>
#include <system_error>

#ifdef __linux__
#include <sys/auxv.h>
#endif

namespace lightproof {
namespace fs = std::filesystem;
namespace {

constexpr const char* kSelf = "/proc/self/exe";

/// What was given to execve(2), or else to the program as its own name, if that is a path.
fs::path name_of_start() {
#ifdef __linux__
  if (const unsigned long name = ::getauxval(AT_EXECFN); name != 0) {
    return std::bit_cast<const char*>(name);
  }
#endif
  const fs::path name = program_invocation_name;
  return name.has_parent_path() ? name : fs::path();
}

}  // namespace

fs::path running_program() {
  std::error_code error;
  if (fs::path program = fs::read_symlink(kSelf, error); !error) return program;
  const fs::path name = name_of_start();
  return name.empty() ? name : fs::absolute(name, error);
}

fs::path running_program_file() {
  std::error_code error;
  return fs::exists(kSelf, error) ? fs::path(kSelf) : running_program();
}

}  // namespace lightproof
