// Files and folders that results go to.
#pragma once

#include <CLI/App.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "command_line.h"
#include "lightproof/report/result_folder.h"

namespace lightproof::cli {

/// The name of the standard output among the outputs.
inline constexpr std::string_view kStandardOutput = "-";

/// Adds an option for a file that is written; "-" is the standard output.
CLI::Option* add_output(CLI::App& command, const std::string& name, std::string& path,
                        const std::string& description);

/// Adds --force, for commands that write a folder.
void add_force(CLI::App& command, bool& force);

/// Whether one of the outputs is the standard output, so that nothing else may go there. Throws
/// InputError if several are, or if one cannot be written: before minutes are spent. Empty names
/// are outputs that nobody asked for.
bool check_outputs(std::span<const std::string> paths);

/// write_file(), or to the standard output. An empty name writes nothing.
void write_output(const std::string& path, std::string_view content);

/// check_result_folder(), with the command line that would go on, if --force is what it takes.
/// `names`: those of files that may be written.
void check_folder(const std::string& folder, bool force, const std::set<std::string>& names,
                  const CommandLine& line);

Overwriting overwriting(bool force);

}  // namespace lightproof::cli
