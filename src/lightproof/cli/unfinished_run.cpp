#include "unfinished_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "lightproof/core/error.h"
#include "lightproof/core/kept_file.h"
#include "lightproof/core/machine.h"
#include "lightproof/core/random.h"
#include "lightproof/core/running_program.h"
#include "lightproof/core/text_escapes.h"
#include "lightproof/image/map_identity.h"
#include "messages.h"
#include "outputs.h"

namespace lightproof::cli {
namespace {

std::string hash_text_of(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

/// What no result depends on.
const std::set<std::string>& kept_out() {
  static const std::set<std::string> names = {"MAP",        "--help",   "--output",
                                              "--force",    "--resume", "--threads",
                                              "--progress", "--quiet",  "--color"};
  return names;
}

std::string value_of(const CLI::Option& option) {
  if (option.count() == 0) return option.get_default_str();
  return fmt::format("{}", fmt::join(option.results(), " "));
}

}  // namespace

void add_resume(CLI::App& command, bool& resume) {
  command.add_flag("--resume", resume,
                   "go on with what a run of the same inputs left unfinished in the folder");
}

std::vector<RunInput> program_inputs() {
  const auto hash = hash_of_file(running_program_file());
  return {{"the program", hash ? hash_text_of(*hash) : "unknown"}, {"the machine", machine_name()}};
}

std::vector<RunInput> map_inputs(std::span<const EnvironmentMap> maps) {
  std::vector<RunInput> inputs;
  for (const EnvironmentMap& map : maps) {
    inputs.push_back(
        {"the map " + map.name,
         fmt::format("{}x{} {}", map.radiance.extent().width, map.radiance.extent().height,
                     hash_text_of(hash_text(identity_of(map))))});
  }
  return inputs;
}

std::vector<RunInput> option_inputs(const CLI::App& command,
                                    const std::set<std::string>& left_out) {
  std::vector<RunInput> inputs;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (kept_out().contains(name) || left_out.contains(name)) continue;
    inputs.push_back({name, value_of(*option)});
  }
  return inputs;
}

bool check_run_folder(const RunFolder& folder, const std::set<std::string>& names,
                      const CommandLine& line) {
  const bool replaces =
      folder.force ||
      (folder.resume && is_unfinished_work(std::filesystem::path(folder.output) / kUnfinishedName));
  check_folder(folder.output, replaces, names, line);
  return replaces;
}

UnfinishedWork begin_work(const RunFolder& folder, const std::vector<RunInput>& inputs,
                          const CommandLine& line) {
  const Unfinished earlier = folder.resume  ? Unfinished::continued
                             : folder.force ? Unfinished::discarded
                                            : Unfinished::refused;
  try {
    return {folder.output, inputs, earlier};
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find("--resume goes on") == std::string_view::npos) throw;
    throw Refusal(error.what(), with_flags(line, {"--resume"}));
  }
}

void tell_of_parts(const UnfinishedWork& unfinished, const RunFolder& folder) {
  if (!unfinished.holds_something()) return;
  last_words() =
      fmt::format("What is finished is kept in {}; --resume goes on with it",
                  terminal_text((std::filesystem::path(folder.output) / kUnfinishedName).string()));
}

}  // namespace lightproof::cli
