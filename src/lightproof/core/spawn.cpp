#include "lightproof/core/spawn.h"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

#include "lightproof/core/error.h"

extern char** environ;

namespace lightproof {
namespace {

constexpr mode_t kOwnersAlone = 0600;

/// They fail for lack of memory alone.
void require(int error) {
  if (error != 0) throw std::system_error(error, std::generic_category(), "posix_spawn");
}

}  // namespace

Redirections::Redirections() { require(posix_spawn_file_actions_init(&actions_)); }

Redirections::~Redirections() { posix_spawn_file_actions_destroy(&actions_); }

void Redirections::open(int descriptor, const std::filesystem::path& file, int flags) {
  require(
      posix_spawn_file_actions_addopen(&actions_, descriptor, file.c_str(), flags, kOwnersAlone));
}

void Redirections::duplicate(int ours, int descriptor) {
  require(posix_spawn_file_actions_adddup2(&actions_, ours, descriptor));
}

void Redirections::close(int descriptor) {
  require(posix_spawn_file_actions_addclose(&actions_, descriptor));
}

pid_t spawn(const std::filesystem::path& program, std::vector<std::string> arguments,
            const Redirections& redirections) {
  arguments.insert(arguments.begin(), program.string());
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  const int error =
      posix_spawn(&child, program.c_str(), redirections.get(), nullptr, argv.data(), environ);
  if (error != 0) {
    throw InputError(fmt::format("{}: cannot be started: {}", program.string(),
                                 std::generic_category().message(error)));
  }
  return child;
}

}  // namespace lightproof
