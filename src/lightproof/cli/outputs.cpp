#include "outputs.h"

#include <algorithm>
#include <cstdio>

#include "lightproof/core/atomic_file.h"
#include "lightproof/core/error.h"

namespace lightproof::cli {

CLI::Option* add_output(CLI::App& command, const std::string& name, std::string& path,
                        const std::string& description) {
  return command.add_option(name, path, description + "; - is the standard output")
      ->type_name("PATH")
      ->check([](const std::string& text) { return text.empty() ? "the name is empty" : ""; });
}

void add_force(CLI::App& command, bool& force) {
  command.add_flag("--force", force,
                   "write to a folder that holds something: replaces what the manifest.json of an "
                   "earlier run lists, and leaves all other files");
}

bool check_outputs(std::span<const std::string> paths) {
  const auto to_stdout = std::count(paths.begin(), paths.end(), kStandardOutput);
  if (to_stdout > 1) throw InputError("-: only one output can be the standard output");
  for (const std::string& path : paths) {
    if (!path.empty() && path != kStandardOutput) check_writable(path);
  }
  return to_stdout == 1;
}

void write_output(const std::string& path, std::string_view content) {
  if (path.empty()) return;
  if (path != kStandardOutput) return write_file(path, content);
  std::fwrite(content.data(), 1, content.size(), stdout);  // main() says if that failed
}

void check_folder(const std::string& folder, bool force, const std::set<std::string>& names,
                  const CommandLine& line) {
  try {
    check_result_folder(folder, overwriting(force), names);
  } catch (const InputError& error) {
    if (force || std::string_view(error.what()).find("--force") == std::string_view::npos) throw;
    check_result_folder(folder, Overwriting::of_listed_files, names);
    throw Refusal(error.what(), with_flags(line, {"--force"}));
  }
}

Overwriting overwriting(bool force) {
  return force ? Overwriting::of_listed_files : Overwriting::refused;
}

}  // namespace lightproof::cli
