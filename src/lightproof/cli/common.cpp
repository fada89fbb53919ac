#include "common.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <set>

#include "lightproof/core/error.h"
#include "lightproof/core/out_of_memory.h"
#include "lightproof/image/reader.h"
#include "lightproof/image/synthetic.h"

namespace lightproof::cli {
namespace {

constexpr std::uint64_t kLargestSide = 32768;

/// A whole number in decimal digits only; none if it is anything else or does not fit.
std::optional<std::uint64_t> parse_number(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

EnvironmentMap load_map(const std::string& input, Extent size, const ReadOptions& read) {
  if (input.empty()) throw InputError("a map's name is empty");
  if (is_synthetic(input)) {
    return with_memory_for(
        [&] { return fmt::format("{} ({}x{})", input, size.width, size.height); },
        [&] {
          EnvironmentMap map = make_synthetic_map(input, size);
          map.weights = weights_of(read.luminance);
          return map;
        });
  }
  try {
    return read_environment_map(input, read);
  } catch (const InputError& error) {
    const bool looks_like_a_name = input.find_first_of("./\\") == std::string::npos;
    if (!looks_like_a_name || access(input.c_str(), F_OK) == 0) throw;
    std::string known;
    for (const SyntheticMap& map : synthetic_maps()) known += fmt::format(" {}", map.name);
    throw InputError(
        fmt::format("{}: there is no such file, and no built-in map of this name; built in are:{}",
                    input, known));
  }
}

/// Two files of the same name in different folders must stay apart in tables and file names.
void make_names_unique(std::vector<EnvironmentMap>& maps) {
  std::set<std::string> taken;
  for (EnvironmentMap& map : maps) {
    std::string name = map.name;
    for (int number = 2; !taken.insert(name).second; ++number) {
      name = fmt::format("{}-{}", map.name, number);
    }
    map.name = name;
  }
}

/// Draws the bar at most ten times a second.
class Bar {
 public:
  ~Bar() { std::fputs("\r\033[K", stderr); }

  void show(std::string_view step, double fraction) {
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    if (fraction < 1.0 && now - shown_ < std::chrono::milliseconds(100)) return;
    shown_ = now;
    constexpr int kWidth = 30;
    const int full = std::clamp(static_cast<int>(fraction * kWidth), 0, kWidth);
    fmt::print(stderr, "\r\033[K[{:#<{}}{:.<{}}] {:3.0f} %  {}{}", "", full, "", kWidth - full,
               100.0 * fraction, step, time_left(now, fraction));
    std::fflush(stderr);
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::string time_left(Clock::time_point now, double fraction) const {
    if (fraction <= 0.01) return "";
    const double spent = std::chrono::duration<double>(now - start_).count();
    const long seconds = std::lround(spent * (1.0 / fraction - 1.0));
    return seconds < 60 ? fmt::format(", {} s left", seconds)
                        : fmt::format(", {} min {} s left", seconds / 60, seconds % 60);
  }

  std::mutex mutex_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_{};
};

}  // namespace

void add_common_options(CLI::App& command, CommonOptions& options) {
  command.add_option("MAP", options.maps,
                     "environment maps: files (OpenEXR, Radiance .hdr, PNG, JPEG) or built-in "
                     "names (see `lightproof list maps`)");
  command.add_option("--preset", options.preset,
                     "how the files' pixels map to directions (see `lightproof list presets`)");
  command.add_option("--size", options.size, "WxH of built-in maps")->capture_default_str();
  add_input_options(command, options);
  command.add_flag("--any-aspect", options.any_aspect, "accept maps that are not 2:1");
  add_number(command, "--seed", options.seed, 0, UINT64_MAX, "base seed of all random numbers");
  command.add_option("-t,--threads", options.threads, "threads; 0 is one per core")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  command.add_option("--color", options.color, "colours on stdout (NO_COLOR is honoured)")
      ->check(CLI::IsMember({"auto", "always", "never"}))
      ->capture_default_str();
  command.add_flag("-q,--quiet", options.quiet, "print nothing but errors");
}

CLI::Option* add_number(CLI::App& command, const std::string& name, std::uint64_t& value,
                        std::uint64_t least, std::uint64_t most, const std::string& description) {
  const auto read = [&value, least, most, name](const std::string& text) {
    const auto number = parse_number(text);
    if (!number || *number < least || *number > most) {
      throw CLI::ValidationError(
          name, fmt::format("'{}' is not a whole number from {} to {}", text, least, most));
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
      ->check([](const std::string& text) { return text.empty() ? "the name is empty" : ""; });
}

bool is_synthetic(const std::string& name) {
  const auto maps = synthetic_maps();
  return std::any_of(maps.begin(), maps.end(), [&](const auto& map) { return map.name == name; });
}

ReadOptions read_options(const CommonOptions& options) {
  ReadOptions read{.any_aspect = options.any_aspect};
  apply(options, read);
  if (options.preset.empty()) return read;
  read.preset = preset_by_name(options.preset);
  if (read.preset) return read;
  std::string known;
  for (const PresetInfo& preset : presets()) known += fmt::format(" {}", preset.name);
  throw InputError(fmt::format("--preset: there is no '{}'; there are:{}", options.preset, known));
}

Extent parse_size(const std::string& text) {
  const std::size_t cross = text.find('x');
  if (cross != std::string::npos) {
    const auto width = parse_number(std::string_view(text).substr(0, cross));
    const auto height = parse_number(std::string_view(text).substr(cross + 1));
    const auto fits = [](const auto& side) { return side && *side >= 1 && *side <= kLargestSide; };
    if (fits(width) && fits(height)) {
      return {static_cast<int>(*width), static_cast<int>(*height)};
    }
  }
  throw InputError(
      fmt::format("--size: '{}' is not WIDTHxHEIGHT with sides from 1 to {}", text, kLargestSide));
}

std::vector<EnvironmentMap> load_maps(const CommonOptions& options) {
  std::vector<std::string> inputs = options.maps;
  if (inputs.empty()) {
    for (const SyntheticMap& map : synthetic_maps()) inputs.emplace_back(map.name);
  }
  const Extent size = parse_size(options.size);
  const ReadOptions read = read_options(options);
  std::vector<EnvironmentMap> maps;
  for (const std::string& input : inputs) {
    maps.push_back(load_map(input, size, read));
    maps.back().source = input;
    if (options.quiet) continue;
    for (const std::string& note : maps.back().notes) {
      fmt::print(stderr, "{}: {}\n", input, note);
    }
  }
  make_names_unique(maps);
  return maps;
}

std::string input_options(const CommonOptions& options) {
  std::string text;
  if (!options.preset.empty()) text += " --preset " + options.preset;
  if (options.size != CommonOptions{}.size) text += " --size " + options.size;
  if (options.any_aspect) text += " --any-aspect";
  return text + words_of(options);
}

Progress progress_bar(const CommonOptions& options) {
  if (options.quiet || isatty(STDERR_FILENO) == 0) return {};
  return [bar = std::make_shared<Bar>()](std::string_view step, double fraction) {
    bar->show(step, fraction);
  };
}

bool use_color(const CommonOptions& options) {
  if (options.color != "auto") return options.color == "always";
  const char* no_color = std::getenv("NO_COLOR");
  return (no_color == nullptr || *no_color == '\0') && isatty(STDOUT_FILENO) != 0;
}

}  // namespace lightproof::cli
