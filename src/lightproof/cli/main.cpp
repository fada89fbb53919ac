#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <system_error>

#include "common.h"
#include "lightproof/core/error.h"
#include "lightproof/core/failure.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/text_escapes.h"
#include "usage_errors.h"

namespace {

volatile std::sig_atomic_t caught_signal = 0;

/// The first Ctrl-C stops in good order; the second one at once.
void on_interrupt(int signal) {
  caught_signal = signal;
  lightproof::request_interrupt();
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

/// What the standard output could not hold is no result.
bool is_stdout_written() {
  const bool flushed = std::fflush(stdout) == 0;
  return flushed && std::ferror(stdout) == 0;
}

void print_error(const lightproof::InputError& error) {
  fmt::print(stderr, "lightproof: {}\n", lightproof::terminal_text(error.what()));
}

int refuse_stdout(int error) {
  fmt::print(stderr, "lightproof: cannot write to the standard output: {}\n",
             std::generic_category().message(error));
  return lightproof::cli::kBadInput;
}

int fail(const std::exception_ptr& error) {
  const lightproof::Failure failure = lightproof::failure_of(error);
  // The request for a report has lines of its own; names in other messages must not start any.
  const bool has_lines = failure.code == lightproof::kProgramFailed;
  fmt::print(stderr, "lightproof: {}\n",
             has_lines ? lightproof::terminal_lines(failure.message)
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
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "{}", usage_error(app, line, error));
    return kBadInput;
  } catch (const lightproof::Interrupted&) {
    fmt::print(stderr, "lightproof: interrupted; nothing half-written was left\n");
    return kInterrupted + caught_signal;
  } catch (const Refusal& refusal) {
    print_error(refusal);
    fmt::print(stderr, "This would go on: {}\n", refusal.command());
    return kBadInput;
  } catch (const lightproof::InputError& error) {
    print_error(error);
    return kBadInput;
  }
  if (!is_stdout_written()) return refuse_stdout(errno);
  return exit_code;
}

/// Calls the handler for this signal, unless whoever started the program wants the signal ignored,
/// as nohup and background jobs do.
void catch_signal(int signal) {
  if (std::signal(signal, on_interrupt) == SIG_IGN) std::signal(signal, SIG_IGN);
}

}  // namespace

int main(int argc, char** argv) {
  catch_signal(SIGINT);
  catch_signal(SIGTERM);
  try {
    return run(argc, argv);
  } catch (const std::system_error& error) {
    // What is printed says so at once if it is much, and not before the end if it is little.
    return std::ferror(stdout) != 0 ? refuse_stdout(error.code().value())
                                    : fail(std::current_exception());
  } catch (...) {
    return fail(std::current_exception());
  }
}
