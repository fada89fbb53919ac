#include "common.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <string_view>

#include "known_names.h"
#include "lightproof/core/error.h"
#include "lightproof/core/out_of_memory.h"
#include "lightproof/core/text_escapes.h"
#include "lightproof/image/map_description.h"
#include "lightproof/image/reader.h"
#include "lightproof/image/synthetic.h"
#include "messages.h"
#include "progress_display.h"
#include "whole_number.h"

namespace lightproof::cli {
namespace {

constexpr std::uint64_t kLargestSide = 32768;

EnvironmentMap load_map(const std::string& input, Extent size, const ReadOptions& read) {
  if (input.empty()) throw InputError("a map's name is empty");
  if (is_built_in(input)) {
    return with_memory_for(
        [&] { return fmt::format("{} ({}x{})", input, size.width, size.height); },
        [&] {
          EnvironmentMap map = make_synthetic_map(input, size);
          map.weights = weights_of(read.luminance);
          return map;
        });
  }
  try {
    return with_memory_for([&] { return input; },
                           [&] { return read_environment_map(input, read); });
  } catch (const InputError& error) {
    const bool looks_like_a_name = input.find_first_of("./\\") == std::string::npos;
    if (!looks_like_a_name || access(input.c_str(), F_OK) == 0) throw;
    const std::vector<std::string> known = names_of(synthetic_maps());
    throw InputError(fmt::format("there is no such file, and {} (built in: {})",
                                 no_such_name("built-in map", input, known), listed(known)));
  }
}

/// Two files of the same name in different folders must stay apart in tables and file names: a name
/// that nobody has so far, which is taken from now on.
std::string unique_name(const std::string& wanted, std::set<std::string>& taken) {
  std::string name = wanted;
  for (int number = 2; !taken.insert(name).second; ++number) {
    name = fmt::format("{}-{}", wanted, number);
  }
  return name;
}

/// A flag that accepts what is refused without; the refusal mentions it.
struct Remedy {
  std::string flag;
  void (*apply)(CommonOptions&);
};

std::vector<Remedy> remedies() {
  return {{"--repair", [](CommonOptions& options) { options.repair_by = "zero"; }},
          {"--any-aspect", [](CommonOptions& options) { options.any_aspect = true; }},
          {"--pad", [](CommonOptions& options) { options.pad = true; }},
          {"--crop", [](CommonOptions& options) { options.crop = true; }},
          {"--to-rgb", [](CommonOptions& options) { options.to_rgb = true; }}};
}

/// What is wrong with a map; empty if it can be read.
std::string fault_of(const std::string& input, Extent size, const ReadOptions& read) {
  try {
    load_map(input, size, read);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

/// Passes the error on, as a Refusal if flags that it mentions, and those that are then mentioned,
/// are all that it takes.
[[noreturn]] void refuse(const InputError& error, const std::string& input,
                         const CommonOptions& options) {
  const Extent size = parse_size(options.size);
  CommonOptions changed = options;
  std::vector<std::string> flags;
  std::string fault = options.command_line.empty() ? "" : error.what();
  while (!fault.empty()) {
    const std::size_t before = flags.size();
    for (const Remedy& remedy : remedies()) {
      const bool is_new = std::ranges::count(flags, remedy.flag) == 0;
      if (!is_new || fault.find(remedy.flag) == std::string::npos) continue;
      remedy.apply(changed);
      flags.push_back(remedy.flag);
    }
    if (flags.size() == before) break;
    fault = fault_of(input, size, read_options(changed));
    if (fault.empty()) throw Refusal(error.what(), with_flags(options.command_line, flags));
  }
  throw InputError(error.what());
}

}  // namespace

void add_common_options(CLI::App& command, CommonOptions& options, const std::string& size_option) {
  command.add_option("MAP", options.maps,
                     "environment maps: files (OpenEXR, Radiance .hdr, PNG, JPEG) or built-in "
                     "names (see `lightproof list maps`)");
  add_shared_options(command, options, size_option);
}

void add_shared_options(CLI::App& command, CommonOptions& options, const std::string& size_option) {
  command.add_option("--preset", options.preset,
                     "how the files' pixels map to directions (see `lightproof list presets`)");
  command.add_option(size_option, options.size, "WxH of built-in maps")->capture_default_str();
  add_input_options(command, options);
  command.add_flag("--any-aspect", options.any_aspect, "accept maps that are not 2:1");
  command.add_flag(
      "--resample", options.resample,
      "bring octahedral pictures, cubes and nodes to texels of latitude and longitude; "
      "`precompute` always does, `study` for all but the gate; other commands keep the file's own "
      "texels");
  command.add_option("--color", options.color, "colours on stdout (NO_COLOR is honoured)")
      ->check(one_of("choice", {"auto", "always", "never"}))
      ->type_name("auto|always|never")
      ->capture_default_str();
  add_run_options(command, options);
}

void add_run_options(CLI::App& command, CommonOptions& options) {
  add_number(command, "--seed", options.seed, 0, UINT64_MAX, "base seed of all random numbers");
  command.add_option("-t,--threads", options.threads, "threads; 0 is one per core")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  add_number(command, "--progress", options.progress_seconds, 0, 86400,
             "seconds between lines of progress on stderr, where it is no terminal; 0: none");
  command.add_flag("-q,--quiet", options.quiet, "print nothing but errors");
}

CLI::Option* add_number(CLI::App& command, const std::string& name, std::uint64_t& value,
                        std::uint64_t least, std::uint64_t most, const std::string& description) {
  const auto read = [&value, least, most, name](const std::string& text) {
    const auto number = whole_number(text);
    if (!number || *number < least || *number > most) {
      throw CLI::ValidationError(name, fmt::format("'{}' is not a whole number from {} to {} ({})",
                                                   text, least, most, kWholeNumberForms));
    }
    value = *number;
  };
  return command.add_option_function<std::string>(name, read, description)
      ->type_name("N")
      ->take_last()
      ->default_str(std::to_string(value));
}

CLI::Option* add_path(CLI::App& command, const std::string& name, std::string& path,
                      const std::string& description) {
  return command.add_option(name, path, description)
      ->type_name("PATH")
      ->check([](const std::string& text) {
        if (text == "-") return "- is no file here; ./- would be one of this name";
        return text.empty() ? "the name is empty" : "";
      });
}

bool is_built_in(const std::string& name) {
  const auto maps = synthetic_maps();
  return std::any_of(maps.begin(), maps.end(), [&](const auto& map) { return map.name == name; });
}

ReadOptions read_options(const CommonOptions& options) {
  ReadOptions read{.any_aspect = options.any_aspect, .resample = options.resample};
  apply(options, read);
  if (options.preset.empty()) return read;
  read.preset = preset_by_name(options.preset);
  if (read.preset) return read;
  const std::vector<std::string> known = names_of(presets());
  throw InputError(fmt::format("--preset: {} ({})", no_such_name("preset", options.preset, known),
                               listed(known)));
}

Extent parse_size(const std::string& text) {
  const std::size_t cross = text.find('x');
  if (cross != std::string::npos) {
    const auto width = whole_number_in_digits(std::string_view(text).substr(0, cross));
    const auto height = whole_number_in_digits(std::string_view(text).substr(cross + 1));
    const auto fits = [](const auto& side) { return side && *side >= 1 && *side <= kLargestSide; };
    if (fits(width) && fits(height)) {
      return {static_cast<int>(*width), static_cast<int>(*height)};
    }
  }
  throw InputError(
      fmt::format("--size: '{}' is not WIDTHxHEIGHT with sides from 1 to {}", text, kLargestSide));
}

namespace {

/// Reads all maps in their order, and hands each on as take(map, size, read): how the map can be
/// read again.
template <class Take>
void read_maps(const CommonOptions& options, TexelsOfMaps texels, const Take& take) {
  std::vector<std::string> inputs = options.maps;
  if (inputs.empty()) {
    for (const SyntheticMap& map : synthetic_maps()) inputs.emplace_back(map.name);
  }
  const Extent size = parse_size(options.size);
  ReadOptions read = read_options(options);
  if (!options.preset.empty() && std::ranges::all_of(inputs, is_built_in)) {
    throw InputError(
        "--preset: it says how the pixels of a file map to directions, and no file is read: "
        "built-in "
        "maps have Lightproof's own axes");
  }
  if (texels == TexelsOfMaps::lat_long) read.resample = true;
  std::set<std::string> taken;
  for (const std::string& input : inputs) {
    std::optional<EnvironmentMap> map;
    try {
      map = load_map(input, size, read);
    } catch (const InputError& error) {
      refuse(error, input, options);
    }
    map->source = input;
    map->name = unique_name(map->name, taken);
    if (!options.quiet) {
      for (const std::string& note : map->notes) {
        tell("{}\n", terminal_text(fmt::format("{}: {}", input, note)));
      }
    }
    take(*std::move(map), size, read);
  }
}

}  // namespace

std::vector<EnvironmentMap> load_maps(const CommonOptions& options, TexelsOfMaps texels) {
  std::vector<EnvironmentMap> maps;
  read_maps(options, texels, [&](EnvironmentMap map, Extent /*size*/, const ReadOptions& /*read*/) {
    maps.push_back(std::move(map));
  });
  return maps;
}

CheckedMaps check_maps(const CommonOptions& options) {
  CheckedMaps maps;
  MapStore store;
  read_maps(options, TexelsOfMaps::own,
            [&](EnvironmentMap map, Extent size, const ReadOptions& read) {
              maps.descriptions.push_back(json_of(describe(map)));
              const auto read_again = [input = map.source, name = map.name, size, read] {
                EnvironmentMap again = load_map(input, size, read);
                again.source = input;
                again.name = name;
                return again;
              };
              maps.sources.push_back(store.add(std::move(map), read_again));
            });
  return maps;
}

std::string input_options(const CommonOptions& options) {
  std::string text;
  if (!options.preset.empty()) text += " --preset " + shell_word(options.preset);
  if (options.size != CommonOptions{}.size) text += " --size " + options.size;
  if (options.any_aspect) text += " --any-aspect";
  if (options.resample) text += " --resample";
  return text + words_of(options);
}

Progress progress_of(const CommonOptions& options) {
  if (options.quiet) return {};
  return progress_display(std::chrono::seconds(options.progress_seconds));
}

bool use_color(const CommonOptions& options, int stream) {
  if (options.color != "auto") return options.color == "always";
  const char* no_color = std::getenv("NO_COLOR");
  return (no_color == nullptr || *no_color == '\0') && isatty(stream) != 0;
}

}  // namespace lightproof::cli
