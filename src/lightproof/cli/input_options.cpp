#include "input_options.h"

#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <string_view>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/text_escapes.h"

namespace lightproof::cli {
namespace {

constexpr int kLargestPart = 1023;

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> names(1);
  for (const char c : text) {
    if (c == ',') {
      names.emplace_back();
    } else {
      names.back().push_back(c);
    }
  }
  return names;
}

std::vector<std::string> channel_names(const std::string& text) {
  if (text.empty()) return {};
  std::vector<std::string> names = split_at_commas(text);
  const bool named = std::ranges::none_of(names, &std::string::empty);
  if (named && (names.size() == 1 || names.size() == 3)) return names;
  throw InputError(fmt::format(
      "--channels: '{}' is neither three names for red, green and blue, like R,G,B, nor one",
      text));
}

LuminanceChoice choice_of(std::string_view name, bool allows_max) {
  if (allows_max && name == "max") return LuminanceChoice::rec709;
  if (name == "rec709") return LuminanceChoice::rec709;
  if (name == "published") return LuminanceChoice::published;
  if (name == "average") return LuminanceChoice::average;
  if (name == "file") return LuminanceChoice::file;
  throw InputError(fmt::format("luminance: \"{}\" is none of rec709, published, average,{} file",
                               terminal_text(name), allows_max ? " max," : ""));
}

/// A word that a shell reads as it is.
std::string quoted(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("_-.,/").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (std::ranges::all_of(word, is_plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

void add_input_options(CLI::App& command, InputOptions& options) {
  command
      .add_flag(
          "--repair{zero}", options.repair_by,
          "read maps with negative, NaN or infinite values, and say what was done: `zero` (as "
          "without a value) sets them to 0, `--repair=clamp` +Inf to the largest finite value "
          "and the others to 0")
      ->check(CLI::IsMember({"zero", "clamp"}))
      ->take_last();
  command
      .add_option("--channels", options.channels,
                  "names of the channels that are red, green and blue (R,G,B), or of one that is "
                  "read as grey")
      ->type_name("NAME[,NAME,NAME]");
  command
      .add_option("--layer", options.layer, "read the channels NAME.R, NAME.G and NAME.B (OpenEXR)")
      ->type_name("NAME");
  command.add_option("--part", options.part, "part of an OpenEXR file, counted from 0")
      ->type_name("N")
      ->check(CLI::Range(0, kLargestPart));
  command.add_flag("--pad", options.pad,
                   "read OpenEXR files whose data window is smaller than the display window: what "
                   "is missing is black");
  command.add_flag(
      "--crop", options.crop,
      "read OpenEXR files whose data window reaches beyond the display window: what is "
      "outside is left out");
  command.add_flag("--to-rgb", options.to_rgb,
                   "read files of luminance and chroma (Y, RY, BY) or of CIE XYZ, converted to "
                   "linear RGB");
  std::vector<std::string> luminances = {"rec709", "published", "average", "file"};
  if (options.allows_max) luminances.emplace_back("max");
  command
      .add_option(
          "--luminance", options.luminance,
          fmt::format(
              "weights of red, green and blue in the luminance that samplers draw "
              "by: rec709, published (the lecture's), average, or file (as the "
              "header's chromaticities imply){}",
              options.allows_max ? "; max is the largest of the three, in `check` alone" : ""))
      ->check(CLI::IsMember(luminances))
      ->capture_default_str();
}

void apply(const InputOptions& options, ReadOptions& read) {
  if (options.repair_by == "zero") read.repair = Repair::zero;
  if (options.repair_by == "clamp") read.repair = Repair::clamp;
  read.selection = {channel_names(options.channels), options.layer, options.part};
  read.allow = {.pad = options.pad, .crop = options.crop, .to_rgb = options.to_rgb};
  read.luminance = choice_of(options.luminance, options.allows_max);
}

std::string words_of(const InputOptions& options) {
  std::string text;
  if (options.repair_by == "zero") text += " --repair";
  if (options.repair_by == "clamp") text += " --repair=clamp";
  if (!options.channels.empty()) text += " --channels " + quoted(options.channels);
  if (!options.layer.empty()) text += " --layer " + quoted(options.layer);
  if (options.part) text += fmt::format(" --part {}", *options.part);
  if (options.pad) text += " --pad";
  if (options.crop) text += " --crop";
  if (options.to_rgb) text += " --to-rgb";
  if (options.luminance != InputOptions{}.luminance) text += " --luminance " + options.luminance;
  return text;
}

}  // namespace lightproof::cli
