// The command line as it was typed, and how another one would have gone on.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightproof/core/error.h"

namespace lightproof::cli {

/// The program's name and its arguments.
using CommandLine = std::vector<std::string>;

/// A command line as text, quoted for a shell.
std::string text_of(const CommandLine& line);

/// A command line with `flags` at the end of its options: before a "--", if there is one.
CommandLine with_flags(CommandLine line, const std::vector<std::string>& flags);

/// Input that is refused, although another command line accepts it.
class Refusal : public InputError {
 public:
  Refusal(const std::string& message, const CommandLine& accepted)
      : InputError(message), command_(text_of(accepted)) {}

  /// The command line that goes on, quoted for a shell.
  const std::string& command() const { return command_; }

 private:
  std::string command_;
};

}  // namespace lightproof::cli
