#include "lightproof/core/spawn.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string_view>
#include <system_error>

#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "lightproof/core/error.h"

extern char** environ;

namespace lightproof {
namespace {

constexpr mode_t kOwnersAlone = 0600;

/// They fail for lack of memory alone.
void require(int error) {
  if (error != 0) throw std::system_error(error, std::generic_category(), "posix_spawn");
}

constexpr std::string_view kParent = "LIGHTPROOF_PARENT=";

std::vector<std::string> environment_of_child() {
  std::vector<std::string> all = {std::string(kParent) + std::to_string(::getpid())};
  for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable) {
    if (!std::string_view(*variable).starts_with(kParent)) all.emplace_back(*variable);
  }
  return all;
}

/// As the system's calls take them.
std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
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
  std::vector<std::string> environment = environment_of_child();
  pid_t child = 0;
  const int error = posix_spawn(&child, program.c_str(), redirections.get(), nullptr,
                                pointers_to(arguments).data(), pointers_to(environment).data());
  if (error != 0) {
    throw InputError(fmt::format("{}: cannot be started: {}", program.string(),
                                 std::generic_category().message(error)));
  }
  return child;
}

void end_with_parent() {
#ifdef __linux__
  const char* parent = std::getenv("LIGHTPROOF_PARENT");
  if (parent == nullptr) return;
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  // It may have ended before that.
  if (parent != std::to_string(::getppid())) std::raise(SIGTERM);
#endif
}

}  // namespace lightproof
