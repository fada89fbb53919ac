#include "tests/cli/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef __APPLE__
#include <util.h>
#else
#include <pty.h>
#endif

#include <array>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace lightproof::test {
namespace {

void require(int error, const std::string& what) {
  if (error != 0) throw std::system_error(error, std::generic_category(), what);
}

/// The two ends of a stream of the child. The child gets a copy of `theirs` only.
struct Channel {
  int ours = -1;
  int theirs = -1;
};

Channel make_pipe() {
  std::array<int, 2> ends{};
  require(::pipe(ends.data()) == 0 ? 0 : errno, "pipe");
  for (const int end : ends) ::fcntl(end, F_SETFD, FD_CLOEXEC);
  return {ends[0], ends[1]};
}

Channel make_terminal() {
  Channel channel;
  const winsize size{.ws_row = 25, .ws_col = 100, .ws_xpixel = 0, .ws_ypixel = 0};
  require(::openpty(&channel.ours, &channel.theirs, nullptr, nullptr, &size) == 0 ? 0 : errno,
          "openpty");
  for (const int end : {channel.ours, channel.theirs}) ::fcntl(end, F_SETFD, FD_CLOEXEC);
  return channel;
}

Channel make_channel(bool terminal) { return terminal ? make_terminal() : make_pipe(); }

/// "NAME=" of "NAME=value".
std::string_view name_of(std::string_view variable) {
  return variable.substr(0, variable.find('=') + 1);
}

std::vector<std::string> environment_of(const Command& command) {
  std::vector<std::string> all = command.environment;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    bool replaced = name_of(*variable) == "NO_COLOR=";
    for (const std::string& mine : command.environment) {
      replaced = replaced || name_of(mine) == name_of(*variable);
    }
    if (!replaced) all.emplace_back(*variable);
  }
  return all;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

class Actions {
 public:
  Actions(const Command& command, const Channel& out, const Channel& err) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addchdir_np(&actions_, command.folder.c_str());
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, out.theirs, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, err.theirs, STDERR_FILENO);
  }
  ~Actions() { posix_spawn_file_actions_destroy(&actions_); }
  Actions(const Actions&) = delete;
  Actions& operator=(const Actions&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// A process group of its own; interrupts not ignored, even if the test runs in the background.
class Attributes {
 public:
  Attributes() {
    sigset_t reset;
    sigemptyset(&reset);
    for (const int signal : {SIGINT, SIGTERM, SIGPIPE}) sigaddset(&reset, signal);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setsigdefault(&attributes_, &reset);
  }
  ~Attributes() { posix_spawnattr_destroy(&attributes_); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_{};
};

/// Reads once. A terminal whose other end is closed reports an error instead of an end.
void drain(int& fd, std::string& text) {
  std::array<char, 65536> buffer{};
  const ssize_t count = ::read(fd, buffer.data(), buffer.size());
  if (count < 0 && errno == EINTR) return;
  if (count > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(count));
    return;
  }
  ::close(fd);
  fd = -1;
}

/// The signals that a process handles, as a mask; none once it has ended.
std::uint64_t caught_signals(pid_t id) {
  std::ifstream status(fmt::format("/proc/{}/status", id));
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("SigCgt:")) return std::stoull(line.substr(7), nullptr, 16);
  }
  return 0;
}

}  // namespace

Process::Process(const Command& command) {
  const Channel out = make_channel(command.terminal == Terminal::on_stdout);
  const Channel err = make_channel(command.terminal == Terminal::on_stderr);
  out_fd_ = out.ours;
  err_fd_ = err.ours;
  std::vector<std::string> words = command.words;
  std::vector<std::string> environment = environment_of(command);
  const int error =
      posix_spawnp(&id_, words.front().c_str(), Actions(command, out, err).get(),
                   Attributes().get(), pointers_to(words).data(), pointers_to(environment).data());
  ::close(out.theirs);
  ::close(err.theirs);
  if (error == 0) return;
  ::close(out_fd_);
  ::close(err_fd_);
  require(error, words.front());
}

Process::~Process() {
  if (!reaped_) {
    ::kill(-id_, SIGKILL);
    ::waitpid(id_, nullptr, 0);
  }
  if (out_fd_ >= 0) ::close(out_fd_);
  if (err_fd_ >= 0) ::close(err_fd_);
}

void Process::send(int signal) const {
  if (!reaped_) ::kill(id_, signal);
}

bool Process::read_some() {
  std::array<pollfd, 2> streams = {pollfd{out_fd_, POLLIN, 0}, pollfd{err_fd_, POLLIN, 0}};
  if (::poll(streams.data(), streams.size(), 20) > 0) {
    if (streams[0].revents != 0) drain(out_fd_, out_);
    if (streams[1].revents != 0) drain(err_fd_, err_);
  }
  return out_fd_ >= 0 || err_fd_ >= 0;
}

bool Process::wait_to_catch(int signal, std::chrono::seconds limit) const {
  const auto end = Clock::now() + limit;
  for (; Clock::now() < end; std::this_thread::sleep_for(std::chrono::milliseconds(2))) {
    if ((caught_signals(id_) >> (signal - 1) & 1U) != 0) return true;
  }
  return false;
}

bool Process::wait_for_err(std::string_view text, std::chrono::seconds limit) {
  const auto end = Clock::now() + limit;
  bool open = true;
  while (open && Clock::now() < end && err_.find(text) == std::string::npos) open = read_some();
  return err_.find(text) != std::string::npos;
}

std::optional<int> Process::exit_code() {
  int status = 0;
  rusage usage{};
  if (::wait4(id_, &status, WNOHANG, &usage) != id_) return std::nullopt;
  reaped_ = true;
  peak_kilobytes_ = usage.ru_maxrss;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

Finished Process::wait(std::chrono::seconds limit) {
  const auto end = Clock::now() + limit;
  for (bool open = true; Clock::now() < end;) {
    if (open) {
      open = read_some();
      continue;
    }
    if (const std::optional<int> code = exit_code()) {
      const std::chrono::duration<double> spent = Clock::now() - start_;
      return {*code, out_, err_, spent.count(), peak_kilobytes_};
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  throw std::runtime_error(
      fmt::format("still running after {} s; stderr so far: {}", limit.count(), err_));
}

}  // namespace lightproof::test
