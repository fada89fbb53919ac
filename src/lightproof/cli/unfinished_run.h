// Going on with a run that did not end.
#pragma once

#include <CLI/App.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "command_line.h"
#include "lightproof/core/unfinished_work.h"
#include "lightproof/image/environment_map.h"

namespace lightproof::cli {

/// Where a run writes its results, and what of earlier ones it may touch.
struct RunFolder {
  std::string output;
  bool force = false;   ///< replaces results, and begins anew where work lies unfinished
  bool resume = false;  ///< goes on with unfinished work
};

/// Adds --resume.
void add_resume(CLI::App& command, bool& resume);

/// This program, to the last byte, and the machine: what results depend on beside maps and options.
std::vector<RunInput> program_inputs();

/// The maps by their names, with a hash of all that is seen of them.
std::vector<RunInput> map_inputs(std::span<const EnvironmentMap> maps);

/// The options of a command line that was parsed, with their defaults, but those that are named and
/// those that no result depends on: folders, threads, what is printed.
std::vector<RunInput> option_inputs(const CLI::App& command, const std::set<std::string>& left_out);

/// Throws InputError if results cannot go to the folder, and a Refusal with the command line that
/// would go on where there is one. `names`: those of files that may be written. Returns whether
/// files of an earlier run are replaced: by --force, or because an unfinished run is gone on with
/// that wrote some of them, or was to replace them.
bool check_run_folder(const RunFolder& folder, const std::set<std::string>& names,
                      const CommandLine& line);

/// The work that lies unfinished in the folder, or none. Throws a Refusal with the command line
/// that would go on if there is some and neither --resume nor --force was given, InputError if it
/// is of other inputs.
UnfinishedWork begin_work(const RunFolder& folder, const std::vector<RunInput>& inputs,
                          const CommandLine& line);

/// Lets the program's last words say where parts are kept, if some are.
void tell_of_parts(const UnfinishedWork& unfinished, const RunFolder& folder);

/// work(); if it fails with parts kept, the program's last words say where they are.
template <class Work>
auto keeping_parts(const UnfinishedWork& unfinished, const RunFolder& folder, const Work& work) {
  try {
    return work();
  } catch (...) {
    tell_of_parts(unfinished, folder);
    throw;
  }
}

}  // namespace lightproof::cli
