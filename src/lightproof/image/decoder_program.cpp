#include "lightproof/image/decoder_program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "lightproof-decode";

/// The running program; empty if the system does not say.
fs::path running_program() {
  std::error_code error;
  if (fs::path program = fs::read_symlink("/proc/self/exe", error); !error) return program;
  // Without /proc there is the name by which it was started, if that is a path.
  const fs::path name = program_invocation_name;
  return name.has_parent_path() ? fs::absolute(name, error) : fs::path();
}

std::vector<fs::path> candidates() {
  std::vector<fs::path> found;
  if (const fs::path program = running_program(); !program.empty()) {
    const fs::path folder = program.parent_path();
    found = {folder / kName, folder.parent_path() / kName,
             folder.parent_path() / "libexec" / "lightproof" / kName};
  }
  found.emplace_back(fs::path(LIGHTPROOF_LIBEXEC) / kName);
  return found;
}

bool is_program(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0;
}

}  // namespace

fs::path decoder_program() {
  if (const char* named = std::getenv(kDecoderVariable); named != nullptr && *named != '\0') {
    if (is_program(named)) return named;
    throw InputError(fmt::format(
        "{} names {}, which is no program: unset it, or name the {} of this installation",
        kDecoderVariable, named, kName));
  }
  std::string list;
  for (const fs::path& candidate : candidates()) {
    if (is_program(candidate)) return candidate;
    list += (list.empty() ? "" : ", ") + candidate.string();
  }
  throw InputError(
      fmt::format("the program that reads and writes pictures is missing ({}): install Lightproof "
                  "as a whole, or name {} in {}",
                  list, kName, kDecoderVariable));
}

}  // namespace lightproof
