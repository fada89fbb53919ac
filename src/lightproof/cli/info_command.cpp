// lightproof info: what a file holds, how it would be read, what is wrong with it.
#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <memory>

#include "common.h"
#include "describe_run.h"
#include "lightproof/core/error.h"
#include "lightproof/core/out_of_memory.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/text_escapes.h"
#include "lightproof/dump/sample_convention.h"
#include "lightproof/image/map_description.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/report/map_drawing.h"
#include "messages.h"
#include "outputs.h"

namespace lightproof::cli {
namespace {

struct Options : CommonOptions {
  bool json = false;
  std::string drawing;
};

EnvironmentMap inspect_input(const std::string& input, Extent size, const ReadOptions& read) {
  if (input.empty()) throw InputError("a file's name is empty");
  return with_memory_for([&] { return input; },
                         [&] {
                           const bool made = is_built_in(input);
                           EnvironmentMap map = made ? make_synthetic_map(input, size)
                                                     : inspect_environment_map(input, read);
                           if (made) map.weights = weights_of(read.luminance);
                           map.source = input;
                           return map;
                         });
}

/// What Lightproof's axes are called by a preset's renderers, in capitals: "-X".
std::array<std::string, 3> axis_names(Preset preset) {
  std::string text = axes_of(preset).text();
  std::ranges::transform(text, text.begin(), [](unsigned char letter) {
    return static_cast<char>(std::toupper(letter));
  });
  const std::size_t first = text.find(',');
  const std::size_t second = text.find(',', first + 1);
  return {text.substr(0, first), text.substr(first + 1, second - first - 1),
          text.substr(second + 1)};
}

/// A file in its own convention; a built-in map in that of --preset.
void draw(const EnvironmentMap& map, const ReadOptions& read, const std::string& file) {
  if (file.empty()) return;
  const Preset preset = is_built_in(map.source) && read.preset ? *read.preset : map.origin.preset;
  write_output(file, map_drawing(map, preset, axis_names(preset)));
}

/// Throws InputError if the drawing cannot be written, or would be of several maps.
void check_drawing(const Options& options) {
  if (options.drawing.empty()) return;
  if (options.maps.size() > 1) {
    throw InputError(fmt::format("--drawing is of one map, and {} are given", options.maps.size()));
  }
  if (check_outputs(std::array{options.drawing}) && options.json) {
    throw InputError("-: only one output can be the standard output, the drawing or the JSON");
  }
}

int run(const Options& options) {
  const ThreadLimit threads(options.threads);
  const Extent size = parse_size(options.size);
  const ReadOptions read = read_options(options);
  check_drawing(options);
  const bool prints = options.drawing != kStandardOutput;
  int exit_code = kPassed;
  std::vector<MapDescription> maps;
  for (const std::string& input : options.maps) {
    try {
      const EnvironmentMap map = inspect_input(input, size, read);
      maps.push_back(describe(map));
      if (!options.json && prints) fmt::print("{}", text_of(maps.back()));
      draw(map, read, options.drawing);
    } catch (const InputError& error) {
      tell("lightproof: {}\n", terminal_text(error.what()));
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
  add_output(*command, "--drawing", options->drawing,
             "an SVG file: how the picture lies on the sphere, with its coordinates, angles and "
             "axes; of a built-in map in the convention of --preset");
  command->footer(
      "Files that other commands refuse for their values or shape are described, and their faults\n"
      "listed. Exit codes: 0 all files were read, 2 usage, or some were not.");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace lightproof::cli
