// Other programs, started with descriptors of one's choice.
#pragma once

#include <spawn.h>
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace lightproof {

/// What becomes of the descriptors of a program that is started.
class Redirections {
 public:
  Redirections();
  ~Redirections();
  Redirections(const Redirections&) = delete;
  Redirections& operator=(const Redirections&) = delete;

  /// `descriptor` is a file, opened with these flags, and made with mode 0600 if they say so.
  void open(int descriptor, const std::filesystem::path& file, int flags);
  /// `descriptor` is what `ours` is in this process.
  void duplicate(int ours, int descriptor);
  /// `descriptor` is closed.
  void close(int descriptor);

  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// Starts a program with these words behind its name and this process's environment, in which
/// LIGHTPROOF_PARENT is the number of this process. Throws InputError naming the program if it
/// cannot be started.
pid_t spawn(const std::filesystem::path& program, std::vector<std::string> arguments,
            const Redirections& redirections);

/// In a program that spawn() started: lets it end (SIGTERM) with the process that started it, even
/// if that is killed. Else, and where the system cannot do that, does nothing. The thread that
/// called spawn() must last as long as the program is wanted.
void end_with_parent();

}  // namespace lightproof
