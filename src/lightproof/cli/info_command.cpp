// lightproof info: what a file holds, how it would be read, what is wrong with it.
#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>

#include "common.h"
#include "describe_run.h"
#include "lightproof/core/error.h"
#include "lightproof/core/out_of_memory.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/text_escapes.h"
#include "lightproof/image/map_description.h"
#include "lightproof/image/synthetic.h"

namespace lightproof::cli {
namespace {

struct Options : CommonOptions {
  bool json = false;
};

MapDescription describe_input(const std::string& input, Extent size, const ReadOptions& read) {
  if (input.empty()) throw InputError("a file's name is empty");
  return with_memory_for([&] { return input; },
                         [&] {
                           const bool made = is_built_in(input);
                           EnvironmentMap map = made ? make_synthetic_map(input, size)
                                                     : inspect_environment_map(input, read);
                           if (made) map.weights = weights_of(read.luminance);
                           map.source = input;
                           return describe(map);
                         });
}

int run(const Options& options) {
  const ThreadLimit threads(options.threads);
  const Extent size = parse_size(options.size);
  const ReadOptions read = read_options(options);
  int exit_code = kPassed;
  std::vector<MapDescription> maps;
  for (const std::string& input : options.maps) {
    try {
      maps.push_back(describe_input(input, size, read));
      if (!options.json) fmt::print("{}", text_of(maps.back()));
    } catch (const InputError& error) {
      fmt::print(stderr, "lightproof: {}\n", terminal_text(error.what()));
      exit_code = kBadInput;
    }
  }
  const bool several = options.maps.size() > 1;
  if (options.json && (several || !maps.empty())) {
    fmt::print("{}", info_json(maps, describe_run(options.command_line), several));
  }
  return exit_code;
}

}  // namespace

void add_info(CLI::App& app, const CommandLine& line, int& exit_code) {
  auto options = std::make_shared<Options>();
  options->command_line = line;
  CLI::App* command = app.add_subcommand(
      "info", "What a file holds, how it would be read, and what is wrong with it");
  add_common_options(*command, *options);
  command->get_option("MAP")->required();
  command->add_flag("--json", options->json, "as JSON: an object, or an array for several files");
  command->footer(
      "Files that other commands refuse for their values or shape are described, and their faults\n"
      "listed. Exit codes: 0 all files were read, 2 usage, or some were not.");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace lightproof::cli
