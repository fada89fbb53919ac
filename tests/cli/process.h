// Another program, run as a shell would: its words, folder, environment and terminal on one side,
// its exit code and two streams on the other. posix_spawn() and not fork(), so that the threads of
// a test cannot leave locks behind in the child.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
/// A sanitizer reserves terabytes of addresses, and keeps what was freed for a while: neither
/// limits nor peaks of memory say anything of the program.
inline constexpr bool kHasOwnMemory = false;
#else
inline constexpr bool kHasOwnMemory = true;
#endif

namespace lightproof::test {

/// How long a program may take: under a sanitizer everything takes ten times as long.
inline constexpr std::chrono::seconds kPatience{kHasOwnMemory ? 120 : 900};

/// Which stream of the program is a terminal; the other one is a pipe.
enum class Terminal { none, on_stdout, on_stderr };

struct Command {
  std::vector<std::string> words;  ///< the program's path and its arguments
  std::filesystem::path folder = ".";
  /// "NAME=value", on top of the test's own environment without NO_COLOR.
  std::vector<std::string> environment = {};
  Terminal terminal = Terminal::none;
};

struct Finished {
  int exit_code = 0;  ///< 128 + signal if one killed the program
  std::string out;
  std::string err;
  double seconds = 0.0;
  long peak_kilobytes = 0;  ///< the most memory that it held at once
};

/// A running program in a process group of its own, which is killed when this goes out of scope.
class Process {
 public:
  /// Throws std::system_error if it cannot be started.
  explicit Process(const Command& command);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t id() const { return id_; }
  /// To the program alone, not to its children.
  void send(int signal) const;
  /// Waits until the program handles the signal itself. False if it ended or the time was over.
  bool wait_to_catch(int signal, std::chrono::seconds limit) const;
  /// Reads until stderr holds the text. False if the program ended or the time was over first.
  bool wait_for_err(std::string_view text, std::chrono::seconds limit);
  /// Reads until both streams end and the program exits. Throws std::runtime_error after `limit`.
  Finished wait(std::chrono::seconds limit = kPatience);

 private:
  using Clock = std::chrono::steady_clock;

  /// Appends what arrives within 20 ms; false once both streams have ended.
  bool read_some();
  std::optional<int> exit_code();

  pid_t id_ = 0;
  int out_fd_ = -1;
  int err_fd_ = -1;
  bool reaped_ = false;
  long peak_kilobytes_ = 0;
  Clock::time_point start_ = Clock::now();
  std::string out_;
  std::string err_;
};

inline Finished run(const Command& command) { return Process(command).wait(); }

}  // namespace lightproof::test
