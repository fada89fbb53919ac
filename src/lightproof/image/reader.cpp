#include "lightproof/image/reader.h"

#include <fmt/format.h>

#include <limits>

#include "lightproof/image/image_file.h"
#include "lightproof/image/reproject.h"
#include "lightproof/image/texel_faults.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

std::string size_text(Extent extent) { return fmt::format("{} x {}", extent.width, extent.height); }

Preset choose_preset(const ImageFile& image, const ReadOptions& options,
                     std::vector<std::string>& notes) {
  if (options.preset) return *options.preset;
  if (!image.says_lat_long()) return Preset::z_up;
  notes.push_back("The envmap attribute says latlong: read with preset openexr.");
  return Preset::openexr;
}

/// Node-centred pictures come as 2n x n and as (2n + 1) x (n + 1).
bool is_two_to_one(Extent extent, const PresetInfo& preset) {
  return extent.width == 2 * extent.height ||
         (preset.lattice == Lattice::node_centred && extent.width - 1 == 2 * (extent.height - 1));
}

void check_aspect(const fs::path& file, Extent extent, const PresetInfo& preset, bool any_aspect) {
  const bool square = extent.width == extent.height;
  if (preset.aspect == 1.0) {
    if (square) return;
    refuse(file, fmt::format("{} pixels, but preset {} needs a square picture: choose another "
                             "--preset NAME",
                             size_text(extent), preset.name));
  }
  if (preset.lattice == Lattice::node_centred && (extent.width < 2 || extent.height < 2)) {
    refuse(file, fmt::format("{} pixels, but preset {} needs at least 2 x 2: choose another "
                             "--preset NAME",
                             size_text(extent), preset.name));
  }
  if (any_aspect || is_two_to_one(extent, preset)) return;
  refuse(file,
         fmt::format("{} pixels, but a latitude-longitude map is twice as wide as high: "
                     "--any-aspect reads it all the same{}",
                     size_text(extent), square ? ", --preset pbrt-v4 if it is octahedral" : ""));
}

void require_radiance(const fs::path& file, Grid<Rgb>& picture, bool repair,
                      std::vector<std::string>& notes) {
  const TexelScan scan = scan_texels(picture);
  if (!scan.clean() && !repair) {
    refuse(file, fmt::format("{}, counted from 0 at the top left: --repair sets such values to 0",
                             describe_faults(scan)));
  }
  if (!scan.clean()) {
    repair_texels(picture);
    notes.push_back(fmt::format("Set to 0: {}.", describe_faults(scan)));
  }
  if (scan.brightest >= std::numeric_limits<float>::min()) return;
  refuse(file, fmt::format("every texel is black (the greatest value is {}): no light to sample",
                           scan.brightest));
}

void note_mapping(Extent picture, Preset preset, std::vector<std::string>& notes) {
  const PresetInfo& chosen = info(preset);
  const Extent map = map_extent(preset, picture);
  if (chosen.lattice == Lattice::node_centred) {
    notes.push_back(fmt::format("{} nodes interpolated bilinearly to {} texels.",
                                size_text(picture), size_text(map)));
  } else if (map != picture) {
    notes.push_back(fmt::format("{} octahedral pixels brought to {} texels, nearest pixel each.",
                                size_text(picture), size_text(map)));
  } else if (picture.width % 2 != 0 &&
             (preset == Preset::pbrt_v3 || preset == Preset::z_up_half_turn)) {
    notes.push_back("The width is odd: the half turn moved the columns by half a texel.");
  }
}

}  // namespace

EnvironmentMap read_environment_map(const fs::path& file, const ReadOptions& options) {
  ImageFile image(file);
  EnvironmentMap map{file.stem().string(), {}, image.notes()};
  const Preset preset = choose_preset(image, options, map.notes);
  check_aspect(file, image.extent(), info(preset), options.any_aspect);
  Grid<Rgb> picture = image.read_pixels();
  require_radiance(file, picture, options.repair, map.notes);
  note_mapping(picture.extent(), preset, map.notes);
  map.radiance = map_from_picture(preset, picture);
  return map;
}

}  // namespace lightproof
