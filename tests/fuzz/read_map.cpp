#include "tests/fuzz/read_map.h"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "lightproof/image/map_description.h"
#include "lightproof/image/reader.h"
#include "lightproof/warp/preset.h"

namespace lightproof::fuzz {
namespace {

ReadOptions options_of(Input& choice) {
  ReadOptions options;
  // All that is read all the same, so that it is read.
  options.allow = {.pad = true, .crop = true, .to_rgb = true};
  const std::size_t preset = choice.below(presets().size() + 1);
  if (preset > 0) options.preset = presets()[preset - 1].preset;
  options.repair = static_cast<Repair>(choice.below(3));
  options.luminance = static_cast<LuminanceChoice>(choice.below(4));
  options.any_aspect = choice.below(2) == 0;
  options.resample = choice.below(4) == 0;
  if (choice.below(8) == 0) options.selection.channels = {"Y"};
  if (choice.below(8) == 0) options.selection.part = 1;
  return options;
}

void require_radiance(const EnvironmentMap& map) {
  if (map.radiance.extent().count() == 0) fail("a map without texels");
  for (const Rgb& texel : map.radiance.values()) {
    for (int i = 0; i < 3; ++i) {
      if (!(texel[i] >= 0.0F) || !std::isfinite(texel[i])) {
        fail(fmt::format("a texel of {} in a map that was read", texel[i]));
      }
    }
  }
}

}  // namespace

void read_map(const std::filesystem::path& file, Input choice) {
  const ReadOptions options = options_of(choice);
  bool is_looked_at = false;
  accepts([&] {
    const EnvironmentMap map = inspect_environment_map(file, options);
    require_radiance(map);
    const MapDescription description = describe(map);
    if (json_of(description).empty() || text_of(description).empty()) fail("no description");
    is_looked_at = map.origin.refusal.empty();
  });
  bool is_read = false;
  accepts([&] {
    const EnvironmentMap map = read_environment_map(file, options);
    require_radiance(map);
    double light = 0.0;
    const Grid<double> luminance = luminance_of(map);
    for (const double of_texel : luminance.values()) light += of_texel;
    if (!(light > 0.0) || !std::isfinite(light)) fail(fmt::format("a map of the light {}", light));
    is_read = true;
  });
  if (is_read && !is_looked_at) fail("a file is read of which is said that it is not");
}

}  // namespace lightproof::fuzz
