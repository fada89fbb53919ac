#include "lightproof/core/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <optional>
#include <system_error>
#include <thread>

#include "lightproof/core/child_status.h"
#include "lightproof/core/error.h"
#include "lightproof/core/failure.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/spawn.h"
#include "lightproof/core/system_call.h"
#include "lightproof/core/temporary_folder.h"

namespace lightproof {
namespace fs = std::filesystem;
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPollInterval{20};
/// The time that a child has to end after it was asked to.
constexpr milliseconds kGrace{2000};

[[noreturn]] void fail(const fs::path& program, const char* what, int error) {
  throw InputError(
      fmt::format("{}: {}: {}", program.string(), what, std::generic_category().message(error)));
}

/// Standard output goes to nowhere, standard error to a file.
pid_t start(const fs::path& program, const std::vector<std::string>& arguments,
            const fs::path& errors) {
  Redirections redirections;
  redirections.open(STDOUT_FILENO, "/dev/null", O_WRONLY);
  redirections.open(STDERR_FILENO, errors, O_WRONLY | O_CREAT | O_TRUNC);
  return spawn(program, arguments, redirections);
}

/// The exit status of a child that has ended; none while it runs.
std::optional<int> status_of(const fs::path& program, pid_t child) {
  int status = 0;
  const pid_t ended = uninterrupted([&] { return ::waitpid(child, &status, WNOHANG); });
  if (ended == -1) fail(program, "it is not known how it ended (waitpid)", errno);
  return ended == child ? std::optional(status) : std::nullopt;
}

/// Asks the child to end, and ends it if it does not.
void end(const fs::path& program, pid_t child) {
  // It cannot be gone before it is waited for; one that runs as somebody else is left alone.
  if (::kill(child, SIGTERM) != 0) return;
  const auto deadline = std::chrono::steady_clock::now() + kGrace;
  while (!status_of(program, child)) {
    if (std::chrono::steady_clock::now() > deadline) ::kill(child, SIGKILL);
    std::this_thread::sleep_for(kPollInterval);
  }
}

/// The child's status. An interrupt of this process ends the child first.
int wait_for(const fs::path& program, pid_t child) {
  for (;;) {
    if (const std::optional<int> status = status_of(program, child)) return *status;
    try {
      throw_if_interrupted();
    } catch (const Interrupted&) {
      end(program, child);
      throw;
    }
    std::this_thread::sleep_for(kPollInterval);
  }
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
  const ChildStatusKept status_kept;
  const int status = wait_for(program, start(program, arguments, errors));
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw_if_interrupted();  // a Ctrl-C reaches both
  const std::string why = WIFSIGNALED(status)
                              ? fmt::format("ended by signal {}", WTERMSIG(status))
                              : fmt::format("ended with status {}", WEXITSTATUS(status));
  const std::string said = last_line(errors);
  const std::string message =
      fmt::format("{}: {}{}{}", program.string(), why, said.empty() ? "" : ": ", said);
  if (WIFEXITED(status) && WEXITSTATUS(status) == kMemoryFailed) throw OutOfMemory(message);
  if (WIFEXITED(status) && WEXITSTATUS(status) == kProgramFailed) throw std::runtime_error(message);
  throw InputError(message);
}

}  // namespace lightproof
