// Options that say what of a file becomes a map, and how.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "lightproof/image/reader.h"

namespace lightproof::cli {

struct InputOptions {
  std::string repair_by;  ///< "zero", "clamp"; empty: faulty files are refused
  std::string channels;   ///< "R,G,B" or one name
  std::string layer;
  std::optional<int> part = {};
  bool pad = false;
  bool crop = false;
  bool to_rgb = false;
  std::string luminance = "rec709";
  /// Whether --luminance may be max, the largest of red, green and blue: whoever allows it makes
  /// the map grey by map_of_largest_channel(), since samplers know weights alone.
  bool allows_max = false;
};

/// Adds --repair, --channels, --layer, --part, --pad, --crop, --to-rgb and --luminance.
void add_input_options(CLI::App& command, InputOptions& options);

/// Throws InputError if --channels names neither one channel nor three.
void apply(const InputOptions& options, ReadOptions& read);

/// The options that differ from the defaults as words of a command line, each after a space.
std::string words_of(const InputOptions& options);

}  // namespace lightproof::cli
