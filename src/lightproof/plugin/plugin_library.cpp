#include "lightproof/plugin/plugin_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "lightproof/core/error.h"
#include "lightproof/core/text_escapes.h"
#include "lightproof/samplers/mass_rounding.h"

namespace lightproof {
namespace {

constexpr std::size_t kLongestName = 64;
/// More than any words that mean something have.
constexpr std::size_t kLongestText = 200;
/// What single precision leaves of a direction: some units in the last place of its components.
constexpr double kRoundingOfFloats = 5e-7;
constexpr double kMostRounding = 1e-2;

/// Throws InputError about one of the words that a plug-in describes itself by.
[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view what,
                         const std::string& why) {
  throw InputError(fmt::format("{}: the plug-in describes its {}: {}", file.string(), what, why));
}

/// What a word stands for; an empty one for the first.
template <class Value, std::size_t kCount>
Value chosen(const std::filesystem::path& file, std::string_view what, const std::string& word,
             const std::array<std::pair<std::string_view, Value>, kCount>& values) {
  if (word.empty()) return values.front().second;
  std::string known;
  for (const auto& [name, value] : values) {
    if (name == word) return value;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", name);
  }
  refuse(file, what, fmt::format("\"{}\" is none of {}", terminal_text(word), known));
}

PluginDescription description_of(const std::filesystem::path& file, const PluginOptions& options) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    throw InputError(fmt::format(
        "{}: there is no such file: --plugin takes the path of a shared library", file.string()));
  }
  PluginDescription description = PluginProcess(file, options.limits, nullptr).describe();
  const std::pair<std::string_view, const std::string*> texts[] = {
      {"name", &description.name},          {"columns", &description.columns},
      {"axes", &description.axes},          {"preset", &description.preset},
      {"measure", &description.measure},    {"density", &description.density},
      {"luminance", &description.luminance}};
  for (const auto& [what, text] : texts) {
    if (text->size() > kLongestText) {
      refuse(file, what, fmt::format("{} characters are more than {}", text->size(), kLongestText));
    }
  }
  return description;
}

std::string name_of(const std::filesystem::path& file, const PluginDescription& description) {
  std::string name = description.name;
  if (name.empty()) {
    name = file.stem().string();
    if (name.starts_with("lib")) name.erase(0, 3);
  }
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("._-").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (name.empty() || name.size() > kLongestName || !std::ranges::all_of(name, is_plain)) {
    refuse(file, "name",
           fmt::format("\"{}\" has other characters than letters, digits, and . _ -, or is longer "
                       "than {}",
                       terminal_text(name), kLongestName));
  }
  return name;
}

SampleColumns columns_of(const std::filesystem::path& file, const std::string& words) {
  std::vector<std::string> names;
  const std::string list = words.empty() ? "x,y,z,pdf" : words;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    names.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  if (names.size() > kMostPluginColumns) {
    refuse(file, "columns", fmt::format("{} are more than {}", names.size(), kMostPluginColumns));
  }
  try {
    return sample_columns(names);
  } catch (const InputError& error) {
    refuse(file, "columns", error.what());
  }
}

/// Pictures of latitude and longitude, texel by texel.
bool is_lat_long(const PresetInfo& preset) {
  return preset.lattice == Lattice::texel_area && preset.aspect == 2.0;
}

Preset preset_of(const std::filesystem::path& file, const std::string& word) {
  if (word.empty()) return Preset::z_up;
  std::string known;
  for (const PresetInfo& preset : presets()) {
    if (!is_lat_long(preset)) continue;
    if (preset.name == word) return preset.preset;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", preset.name);
  }
  refuse(file, "preset",
         fmt::format("\"{}\" is none of latitude and longitude ({})", terminal_text(word), known));
}

SampleRows rows_of(const std::filesystem::path& file, const PluginDescription& description) {
  const SampleColumns columns = columns_of(file, description.columns);
  SampleConvention convention;
  convention.preset = preset_of(file, description.preset);
  if (columns.are_directions()) convention.axes = axes_of(convention.preset);
  if (!description.axes.empty()) {
    if (!columns.are_directions()) {
      refuse(file, "axes", "they are those of directions, and its columns are the picture's");
    }
    try {
      convention.axes = AxisMap::parse(description.axes);
    } catch (const InputError& error) {
      refuse(file, "axes", error.what());
    }
  }
  constexpr std::array<std::pair<std::string_view, DensityMeasure>, 2> kMeasures = {
      {{"solid-angle", DensityMeasure::solid_angle}, {"square", DensityMeasure::square}}};
  convention.measure = chosen(file, "measure", description.measure, kMeasures);
  return {columns, convention};
}

TargetDensity target_of(const std::filesystem::path& file, const PluginDescription& description) {
  constexpr std::array<std::pair<std::string_view, DensitySpace>, 3> kSpaces = {
      {{"C", DensitySpace::sine_weighted},
       {"A", DensitySpace::texture},
       {"B", DensitySpace::solid_angle}}};
  constexpr std::array<std::pair<std::string_view, LuminanceWeights>, 3> kWeights = {
      {{"rec709", kRec709}, {"published", kPublishedLuminance}, {"average", kAverageLuminance}}};
  return {chosen(file, "density", description.density, kSpaces),
          chosen(file, "luminance", description.luminance, kWeights)};
}

double rounding_of(const std::filesystem::path& file, const PluginDescription& description) {
  if (description.rounding == 0.0) return kRoundingOfFloats;
  if (!(description.rounding > 0.0) || description.rounding > kMostRounding) {
    refuse(file, "rounding",
           fmt::format("{:g} is no number of radians from 0 to {:g}", description.rounding,
                       kMostRounding));
  }
  return description.rounding;
}

}  // namespace

PluginLibrary::PluginLibrary(std::filesystem::path file, const PluginOptions& options)
    : file_(std::move(file)),
      options_(options),
      description_(description_of(file_, options)),
      name_(name_of(file_, description_)),
      target_(target_of(file_, description_)),
      rows_(rows_of(file_, description_)),
      rounding_(rounding_of(file_, description_)) {}

struct PluginNotes::State {
  std::mutex mutex;
  std::vector<std::string> notes;
};

PluginNotes::PluginNotes() : state_(std::make_unique<State>()) {}

PluginNotes::~PluginNotes() = default;

void PluginNotes::add(const std::string& note) {
  const std::lock_guard lock(state_->mutex);
  if (std::ranges::find(state_->notes, note) == state_->notes.end()) state_->notes.push_back(note);
}

std::vector<std::string> PluginNotes::all() const {
  const std::lock_guard lock(state_->mutex);
  return state_->notes;
}

SamplerUnderTest sampler_under_test(std::shared_ptr<const PluginLibrary> library,
                                    std::shared_ptr<PluginNotes> notes) {
  SamplerUnderTest under_test;
  under_test.name = library->name();
  under_test.target = library->target();
  under_test.rounding = rounding_of_float_sums;
  under_test.why_meaningless = [](const Mapping& mapping) -> std::string_view {
    return is_plain(mapping) ? "" : "plug-ins get maps in latitude and longitude";
  };
  under_test.bind = [library, notes](const EnvironmentMap& map) {
    return bound_plugin(library, map, notes);
  };
  return under_test;
}

}  // namespace lightproof
