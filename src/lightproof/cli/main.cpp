#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <sstream>
#include <system_error>

#include "common.h"
#include "lightproof/core/error.h"
#include "lightproof/core/failure.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/text_escapes.h"
#include "messages.h"
#include "usage_errors.h"

namespace {

volatile std::sig_atomic_t caught_signal = 0;

/// What asks the program to end: Ctrl-C, the system, a terminal that is closed, a reader of what it
/// prints who is gone.
constexpr std::array kEndings = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};

/// The first signal stops in good order; the second one at once.
void on_interrupt(int signal) {
  caught_signal = signal;
  lightproof::request_interrupt();
  for (const int ending : kEndings) std::signal(ending, SIG_DFL);
  // More may be printed to a reader who is gone.
  if (signal == SIGPIPE) std::signal(SIGPIPE, SIG_IGN);
}

/// What the standard output could not hold is no result.
bool is_stdout_written() {
  const bool flushed = std::fflush(stdout) == 0;
  return flushed && std::ferror(stdout) == 0;
}

void print_error(const lightproof::InputError& error) {
  lightproof::cli::tell("lightproof: {}\n", lightproof::terminal_text(error.what()));
}

int refuse_stdout(int error) {
  lightproof::cli::tell("lightproof: cannot write to the standard output: {}\n",
                        std::generic_category().message(error));
  return lightproof::cli::kBadInput;
}

int fail(const std::exception_ptr& error) {
  const lightproof::Failure failure = lightproof::failure_of(error);
  // The request for a report has lines of its own; names in other messages must not start any.
  const bool has_lines = failure.code == lightproof::kProgramFailed;
  lightproof::cli::tell("lightproof: {}\n", has_lines ? lightproof::terminal_lines(failure.message)
                                                      : lightproof::terminal_text(failure.message));
  return failure.code;
}

int run(int argc, char** argv) {
  using namespace lightproof::cli;
  const CommandLine line(argv, argv + argc);
  CLI::App app("Prove an environment-light sampler right, fast and stable.", "lightproof");
  app.set_version_flag("--version", "lightproof " LIGHTPROOF_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  int exit_code = kPassed;
  add_study(app, line, exit_code);
  add_precompute(app, line, exit_code);
  add_gate(app, line, exit_code);
  add_check(app, line, exit_code);
  add_new_plugin(app, line, exit_code);
  add_recommend(app, line, exit_code);
  add_stability(app, line, exit_code);
  add_info(app, line, exit_code);
  add_history(app, line, exit_code);
  add_list(app, line, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    std::ostringstream text;
    app.exit(help, text, text);
    show(stdout, text.str());
  } catch (const CLI::ParseError& error) {
    tell("{}", usage_error(app, line, error));
    return kBadInput;
  } catch (const lightproof::Interrupted&) {
    if (caught_signal != SIGPIPE) tell("lightproof: interrupted; nothing half-written was left\n");
    return kInterrupted + caught_signal;
  } catch (const Refusal& refusal) {
    print_error(refusal);
    tell("This would go on: {}\n", refusal.command());
    return kBadInput;
  } catch (const lightproof::InputError& error) {
    print_error(error);
    return kBadInput;
  }
  if (!is_stdout_written()) {
    return caught_signal == SIGPIPE ? kInterrupted + SIGPIPE : refuse_stdout(errno);
  }
  return exit_code;
}

/// Calls the handler for this signal, unless whoever started the program wants the signal ignored,
/// as nohup and background jobs do.
void catch_signal(int signal) {
  if (std::signal(signal, on_interrupt) == SIG_IGN) std::signal(signal, SIG_IGN);
}

/// Descriptors 0, 1 and 2, where whoever started the program has closed them, become ones that can
/// neither be read nor written: else the next file to be opened would be taken for the standard
/// output.
void take_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // The lowest free number, which is this one.
    const int taken = ::open("/", O_PATH);
    if (taken >= 0 && taken != stream) ::close(taken);
  }
}

int guarded_run(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::system_error& error) {
    // What is printed says so at once if it is much, and not before the end if it is little.
    if (std::ferror(stdout) == 0) return fail(std::current_exception());
    return caught_signal == SIGPIPE ? lightproof::cli::kInterrupted + SIGPIPE
                                    : refuse_stdout(error.code().value());
  } catch (...) {
    return fail(std::current_exception());
  }
}

}  // namespace

int main(int argc, char** argv) {
  take_closed_streams();
  for (const int ending : kEndings) catch_signal(ending);
  // A file that grows beyond a limit is a write that fails, with a message that names it.
  std::signal(SIGXFSZ, SIG_IGN);
  const int exit_code = guarded_run(argc, argv);
  const std::string& words = lightproof::cli::last_words();
  if (exit_code != lightproof::cli::kPassed && !words.empty()) lightproof::cli::tell("{}\n", words);
  return exit_code;
}
