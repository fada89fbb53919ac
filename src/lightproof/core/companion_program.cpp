#include "lightproof/core/companion_program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/running_program.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> places_of(const std::string& name) {
  std::vector<fs::path> found;
  if (const fs::path program = running_program(); !program.empty()) {
    const fs::path folder = program.parent_path();
    found = {folder / name, folder.parent_path() / name,
             folder.parent_path() / "libexec" / "lightproof" / name};
  }
  found.emplace_back(fs::path(LIGHTPROOF_LIBEXEC) / name);
  return found;
}

bool is_program(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0;
}

}  // namespace

fs::path find_companion(const CompanionProgram& program) {
  const char* named = std::getenv(program.variable.c_str());
  if (named != nullptr && *named != '\0') {
    if (is_program(named)) return named;
    throw InputError(fmt::format(
        "{} names {}, which is no program: unset it, or name the {} of this installation",
        program.variable, named, program.name));
  }
  std::string list;
  for (const fs::path& place : places_of(program.name)) {
    if (is_program(place)) return place;
    list += (list.empty() ? "" : ", ") + place.string();
  }
  throw InputError(
      fmt::format("{} is missing ({}): install Lightproof as a whole, or name {} in {}",
                  program.purpose, list, program.name, program.variable));
}

}  // namespace lightproof
