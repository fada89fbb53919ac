// What the subcommands share: options, maps, progress.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "command_line.h"
#include "input_options.h"
#include "lightproof/core/failure.h"
#include "lightproof/core/progress.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/image/map_store.h"

namespace lightproof::cli {

enum ExitCode : int {
  kPassed = 0,
  kRejected = 1,
  kBadInput = kInputFailed,
  kInconclusive = 3,
  kInternalError = kProgramFailed,
  kOutOfMemory = kMemoryFailed,
  kInterrupted = 128,  ///< plus the number of the signal: 130 for Ctrl-C, 143 for SIGTERM
};

/// How inputs are read and what is shown meanwhile.
struct CommonOptions : InputOptions {
  std::vector<std::string> maps;
  std::string preset;
  std::string size = "512x256";
  std::string color = "auto";
  bool any_aspect = false;
  bool resample = false;
  bool quiet = false;
  int threads = 0;
  std::uint64_t seed = 1;
  std::uint64_t progress_seconds = 30;  ///< between lines of progress, where no bar is drawn
  CommandLine command_line = {};        ///< the command line of these options; may be empty
};

/// Adds the options above; `size_option` is the name of the one for the size of built-in maps.
void add_shared_options(CLI::App& command, CommonOptions& options,
                        const std::string& size_option = "--size");

/// Adds those of the options above that do not depend on maps: seed, threads, progress.
void add_run_options(CLI::App& command, CommonOptions& options);

/// Adds the positional MAP… and the options above.
void add_common_options(CLI::App& command, CommonOptions& options,
                        const std::string& size_option = "--size");

/// The most samples that are drawn for one test.
inline constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 40U;

/// Adds an option for a whole number from `least` to `most`, written as whole_number() reads it.
CLI::Option* add_number(CLI::App& command, const std::string& name, std::uint64_t& value,
                        std::uint64_t least, std::uint64_t most, const std::string& description);

/// Adds an option for a file that is read or a folder, whose name must not be empty, nor "-".
CLI::Option* add_path(CLI::App& command, const std::string& name, std::string& path,
                      const std::string& description);

/// Whether a map goes by this name without a file.
bool is_built_in(const std::string& name);

/// How files are read. Throws InputError if an option makes no sense.
ReadOptions read_options(const CommonOptions& options);

/// "WxH", both at least 1. Throws InputError otherwise.
Extent parse_size(const std::string& text);

/// Reads files and makes built-in maps, in the order of their names on the command line; without
/// any, every built-in map. All options are checked, used or not. Notes of the reader go to stderr
/// unless quiet. Names are made unique. What works in latitude and longitude alone asks for
/// `lat_long`: other texels are resampled, and a note says so. Throws a Refusal if a map is refused
/// that other flags accept.
enum class TexelsOfMaps { own, lat_long };
std::vector<EnvironmentMap> load_maps(const CommonOptions& options,
                                      TexelsOfMaps texels = TexelsOfMaps::own);

/// Maps that are read one by one, all of them once before it returns, so that what is wrong with
/// any is said first; few are in memory at once. The order, the notes and the refusals are those of
/// load_maps().
struct CheckedMaps {
  std::vector<MapSource> sources;
  std::vector<std::string> descriptions;  ///< one JSON object each, RunDescription::maps
};
CheckedMaps check_maps(const CommonOptions& options);

/// The options with which load_maps() would read the same maps again, each after a space.
std::string input_options(const CommonOptions& options);

/// progress_display(), or an empty function if quiet.
Progress progress_of(const CommonOptions& options);

/// Whether a stream (STDOUT_FILENO or STDERR_FILENO) gets colours: --color, NO_COLOR, terminal.
bool use_color(const CommonOptions& options, int stream);

/// Each registers its subcommand, which writes the exit code when it is run. `line` is the command
/// line that will be parsed.
void add_gate(CLI::App& app, const CommandLine& line, int& exit_code);
void add_check(CLI::App& app, const CommandLine& line, int& exit_code);
void add_new_plugin(CLI::App& app, const CommandLine& line, int& exit_code);
void add_precompute(CLI::App& app, const CommandLine& line, int& exit_code);
void add_stability(CLI::App& app, const CommandLine& line, int& exit_code);
void add_study(CLI::App& app, const CommandLine& line, int& exit_code);
void add_info(CLI::App& app, const CommandLine& line, int& exit_code);
void add_recommend(CLI::App& app, const CommandLine& line, int& exit_code);
void add_history(CLI::App& app, const CommandLine& line, int& exit_code);
void add_list(CLI::App& app, const CommandLine& line, int& exit_code);

}  // namespace lightproof::cli
