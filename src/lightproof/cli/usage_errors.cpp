#include "usage_errors.h"

#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <optional>
#include <sstream>
#include <vector>

#include "known_names.h"
#include "lightproof/core/text_escapes.h"

namespace lightproof::cli {
namespace {

/// The command that a line means, as far as its first words name one.
struct Command {
  const CLI::App* app;
  std::string name;  ///< "lightproof history compare"
  std::size_t next;  ///< the first word after the name
};

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

const CLI::App* command_named(const CLI::App& app, const std::string& name) {
  for (const CLI::App* command : commands_of(app)) {
    if (command->check_name(name)) return command;
  }
  return nullptr;
}

Command command_of(const CLI::App& app, const CommandLine& line) {
  Command command{&app, "lightproof", 1};
  while (command.next < line.size()) {
    const CLI::App* below = command_named(*command.app, line[command.next]);
    if (below == nullptr) break;
    command = {below, command.name + " " + line[command.next], command.next + 1};
  }
  return command;
}

/// "lightproof: there is no command 'gat'; did you mean 'gate'? --help lists them"
std::string complaint(const Command& command, std::string_view kind, const std::string& typed,
                      const std::vector<std::string>& known) {
  const std::string reason = no_such_name(kind, typed, known);
  return fmt::format("{}: {}{} --help lists them", command.name, reason,
                     reason.ends_with('?') ? "" : ";");
}

std::optional<std::string> mistyped_command(const Command& command, const CommandLine& line) {
  std::vector<std::string> known;
  for (const CLI::App* below : commands_of(*command.app)) known.push_back(below->get_name());
  if (known.empty() || command.next >= line.size()) return std::nullopt;
  const std::string& typed = line[command.next];
  if (typed.starts_with('-')) return std::nullopt;
  return complaint(command, "command", typed, known);
}

/// Hidden ones are not suggested.
std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty()) continue;
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::optional<std::string> mistyped_option(const CLI::App& app, const Command& command) {
  for (const std::string& word : app.remaining(true)) {
    if (!word.starts_with('-') || word == "-" || word == "--") continue;
    const std::string typed = word.substr(0, word.find('='));
    return complaint(command, "option", typed, option_names(*command.app));
  }
  return std::nullopt;
}

std::string for_terminal(const std::string& lines) {
  std::istringstream in(lines);
  std::string text;
  for (std::string line; std::getline(in, line);) text += terminal_text(line) + "\n";
  return text;
}

}  // namespace

std::string usage_error(const CLI::App& app, const CommandLine& line,
                        const CLI::ParseError& error) {
  const Command command = command_of(app, line);
  if (const auto text = mistyped_command(command, line)) return terminal_text(*text) + "\n";
  if (const auto text = mistyped_option(app, command)) return terminal_text(*text) + "\n";
  std::ostringstream out;
  std::ostringstream err;
  app.exit(error, out, err);
  return "lightproof: " + for_terminal(err.str());
}

}  // namespace lightproof::cli
