#include "lightproof/core/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <system_error>
#include <thread>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/temporary_folder.h"

extern char** environ;

namespace lightproof {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::milliseconds kPollInterval{20};

pid_t start(const fs::path& program, std::vector<std::string> arguments, const fs::path& errors) {
  arguments.insert(arguments.begin(), program.string());
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t child = 0;
  const int error = posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    throw InputError(fmt::format("{}: cannot be started: {}", program.string(),
                                 std::generic_category().message(error)));
  }
  return child;
}

/// The child's status. An interrupt of this process ends the child first.
int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    try {
      throw_if_interrupted();
    } catch (const Interrupted&) {
      ::kill(child, SIGTERM);
      ::waitpid(child, &status, 0);
      throw;
    }
    std::this_thread::sleep_for(kPollInterval);
  }
  return status;
}

std::string last_line(const fs::path& file) {
  std::ifstream in(file);
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

}  // namespace

void run_child(const fs::path& program, const std::vector<std::string>& arguments) {
  const TemporaryFolder folder;
  const fs::path errors = folder / "stderr";
  const int status = wait_for(start(program, arguments, errors));
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw_if_interrupted();  // a Ctrl-C reaches both
  const std::string why = WIFSIGNALED(status)
                              ? fmt::format("ended by signal {}", WTERMSIG(status))
                              : fmt::format("ended with status {}", WEXITSTATUS(status));
  const std::string said = last_line(errors);
  throw InputError(
      fmt::format("{}: {}{}{}", program.string(), why, said.empty() ? "" : ": ", said));
}

}  // namespace lightproof
