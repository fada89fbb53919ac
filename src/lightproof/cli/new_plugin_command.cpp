// lightproof new-plugin: a sampler of one's own to begin with.
#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>

#include "common.h"
#include "known_names.h"
#include "lightproof/core/atomic_file.h"
#include "lightproof/core/error.h"
#include "lightproof/core/text_escapes.h"
#include "lightproof/plugin/skeleton.h"

namespace lightproof::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string language;
  std::string folder;
};

const SkeletonLanguage& language_of(const std::string& name) {
  return *std::ranges::find(skeleton_languages(), name, &SkeletonLanguage::name);
}

/// Throws InputError unless the folder is empty, or can be made.
void check_empty(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error)) {
    throw InputError(fmt::format("{}: is no folder: name a new one", folder.string()));
  }
  if (fs::is_empty(folder, error)) return;
  throw InputError(fmt::format(
      "{}: the folder is not empty: name a new one, nothing is overwritten", folder.string()));
}

void write_all(const fs::path& folder, const std::vector<SkeletonFile>& files) {
  for (const SkeletonFile& file : files) {
    const fs::path path = folder / file.path;
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error) {
      throw InputError(
          fmt::format("{}: cannot be made: {}", path.parent_path().string(), error.message()));
    }
    write_file(path, file.text);
  }
}

int run(const Options& options) {
  const SkeletonLanguage& language = language_of(options.language);
  check_empty(options.folder);
  const fs::path folder = fs::absolute(options.folder).lexically_normal();
  const std::string name =
      sampler_name_of((folder.has_filename() ? folder : folder.parent_path()).filename().string());
  write_all(options.folder, skeleton(language, name));
  const std::string place = shell_word(options.folder);
  const std::string library =
      shell_word((fs::path(options.folder) / with_name(language.library, name)).string());
  fmt::print(
      "{}: a sampler that works, and what builds it. Build and test it by\n"
      "  (cd {} && {})\n"
      "  lightproof gate sun-sky --plugin {}\n",
      terminal_text(options.folder), place, language.build, library);
  return kPassed;
}

}  // namespace

void add_new_plugin(CLI::App& app, const CommandLine& /*line*/, int& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "new-plugin", "Write a sampler of your own to begin with, for `lightproof gate --plugin`");
  std::vector<std::string> names;
  std::string bars;
  for (const SkeletonLanguage& language : skeleton_languages()) {
    names.emplace_back(language.name);
    bars += fmt::format("{}{}", bars.empty() ? "" : "|", language.name);
  }
  command->add_option("LANGUAGE", options->language, "the language of the sampler")
      ->required()
      ->check(one_of("language", names))
      ->type_name(bars);
  command->add_option("DIR", options->folder, "a folder that is new or empty")->required();
  command->footer(
      "What is written is complete: a sampler by binary search under density C, the header\n"
      "lightproof_plugin.h, which says what a plug-in is, and a CMakeLists.txt or Cargo.toml.\n"
      "Exit codes: 0 written, 2 usage or input, 70 internal error, 128 + N ended by signal N.");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace lightproof::cli
