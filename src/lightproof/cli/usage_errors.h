// What is said of a command line that cannot be understood.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "command_line.h"

namespace lightproof::cli {

/// The message for a parse that failed, ready for a terminal, with a newline at its end. A mistyped
/// command or option is answered with the nearest one.
std::string usage_error(const CLI::App& app, const CommandLine& line, const CLI::ParseError& error);

}  // namespace lightproof::cli
