#include "lightproof/image/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lightproof/core/parallel.h"
#include "lightproof/image/file_format.h"
#include "lightproof/image/image_file.h"
#include "lightproof/image/map_figures.h"
#include "lightproof/image/reproject.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

std::string size_text(Extent extent) { return fmt::format("{} x {}", extent.width, extent.height); }

void choose_preset(EnvironmentMap& map, const ReadOptions& options) {
  MapOrigin& origin = map.origin;
  if (options.preset) {
    origin.preset = *options.preset;
    origin.why_preset = "--preset";
  } else if (origin.picture.says_lat_long) {
    origin.preset = Preset::openexr;
    origin.why_preset = "the envmap attribute says latlong";
    map.notes.emplace_back("The envmap attribute says latlong: read with preset openexr.");
  } else {
    origin.preset = Preset::z_up;
    origin.why_preset = "the file says nothing, and --preset was not given";
  }
}

/// Node-centred pictures come as 2n x n and as (2n + 1) x (n + 1).
bool is_two_to_one(Extent extent, const PresetInfo& preset) {
  return extent.width == 2 * extent.height ||
         (preset.lattice == Lattice::node_centred && extent.width - 1 == 2 * (extent.height - 1));
}

bool shows_six_faces(Extent extent) {
  return extent.width == 6 * extent.height || extent.height == 6 * extent.width;
}

void refuse_what_has_no_texel(const fs::path& file, Extent extent, const PresetInfo& preset) {
  if (preset.preset == Preset::cube && !shows_six_faces(extent)) {
    refuse(file,
           fmt::format("{} pixels, but preset {} needs six square faces side by side or below "
                       "each other: choose another --preset NAME",
                       size_text(extent), preset.name));
  }
  if (preset.lattice != Lattice::node_centred || (extent.width >= 2 && extent.height >= 2)) return;
  refuse(file, fmt::format("{} pixels, but preset {} needs at least 2 x 2: choose another "
                           "--preset NAME",
                           size_text(extent), preset.name));
}

/// Which preset a picture that is not of latitude and longitude may need.
std::string_view hint_for(Extent extent) {
  if (extent.width == extent.height) return ", --preset pbrt-v4 if it is octahedral";
  if (shows_six_faces(extent)) {
    return ", --preset cube if it shows the faces of one";
  }
  return "";
}

/// What is wrong with the shape; empty if the convention of the preset allows it.
std::string aspect_fault(Extent extent, const PresetInfo& preset, bool any_aspect) {
  const bool square = extent.width == extent.height;
  if (preset.preset == Preset::cube) return "";
  if (preset.aspect == 1.0) {
    if (square) return "";
    return fmt::format(
        "{} pixels, but preset {} needs a square picture: choose another "
        "--preset NAME",
        size_text(extent), preset.name);
  }
  if (any_aspect || is_two_to_one(extent, preset)) return "";
  return fmt::format(
      "{} pixels, but a latitude-longitude map is twice as wide as high: "
      "--any-aspect reads it all the same{}",
      size_text(extent), hint_for(extent));
}

std::vector<MapFault> faults_of(const TexelScan& scan) {
  std::vector<MapFault> faults;
  for (const TexelFault& fault : scan.faults) {
    if (fault.count == 0) continue;
    faults.push_back(
        {std::string(fault.kind), describe_fault(fault), fault.count, fault.column, fault.row});
  }
  return faults;
}

/// The first reason for a refusal is the one that is told.
void refuse_later(MapOrigin& origin, std::string reason) {
  if (origin.refusal.empty()) origin.refusal = std::move(reason);
}

/// The texels of the map's mapping.
Grid<Rgb> texels_of(const EnvironmentMap& map, const Grid<Rgb>& picture) {
  return map.origin.is_resampled ? map_from_picture(map.origin.preset, picture)
                                 : own_texels_of(map.origin.preset, picture);
}

/// The only note that needs the map itself: how much of its light was put in.
std::string clamp_note(const EnvironmentMap& map, const TexelScan& scan,
                       const Grid<Rgb>& infinite) {
  const EnvironmentMap put_in{.name = {},
                              .radiance = texels_of(map, infinite),
                              .weights = map.weights,
                              .mapping = map.mapping};
  const double share = static_cast<double>(scan.brightest) * figures_of(put_in).mean_luminance /
                       figures_of(map).mean_luminance;
  return fmt::format(
      "Repaired: {}. +Inf became {:.6g}, the largest finite value; -Inf, NaN and "
      "negative values became 0. Where +Inf stood lies now {:.3g} % of the map's "
      "light.",
      describe_faults(scan), scan.brightest, 100.0 * share);
}

std::string zero_note(const TexelScan& scan) {
  const bool any_infinite = scan.count_of(kInfiniteValues) > 0;
  return fmt::format("Set to 0: {}.{}", describe_faults(scan),
                     any_infinite ? " Infinite values may be a light's brightest texels: "
                                    "--repair=clamp sets +Inf to the largest finite value instead."
                                  : "");
}

bool is_lit(Rgb rgb) {
  const auto is_light = [](float v) {
    return v >= std::numeric_limits<float>::min() && std::isfinite(v);
  };
  return is_light(rgb.r) || is_light(rgb.g) || is_light(rgb.b);
}

/// Refuses a picture without light, and one whose light no texel of the map shows: the last column
/// of nodes stands for the first one, and where pixels are resampled, the nearest ones may leave
/// others out. Returns whether the map is black.
bool refuse_black(EnvironmentMap& map, float brightest_of_picture) {
  if (std::ranges::any_of(map.radiance.values(), is_lit)) return false;
  const std::string reason =
      brightest_of_picture < std::numeric_limits<float>::min()
          ? fmt::format("every texel is black (the greatest value is {}): no light to sample",
                        brightest_of_picture)
          : fmt::format(
                "every texel is black: the picture's light, up to {}, is in pixels that no "
                "texel of preset {} shows: choose another --preset NAME",
                brightest_of_picture, info(map.origin.preset).name);
  map.origin.faults.push_back({.kind = "black", .message = reason});
  refuse_later(map.origin, reason);
  return true;
}

/// Makes every value a radiance, and brings the picture into the frame of the map.
void take_pixels(EnvironmentMap& map, Grid<Rgb> picture, Repair repair) {
  const TexelScan scan = scan_texels(picture);
  std::ranges::move(faults_of(scan), std::back_inserter(map.origin.faults));
  if (!scan.clean() && repair == Repair::refuse) {
    const bool any_infinite = scan.count_of(kInfiniteValues) > 0;
    refuse_later(
        map.origin,
        fmt::format("{}, counted from 0 at the top left: --repair sets such values to 0{}",
                    describe_faults(scan),
                    any_infinite ? ", --repair=clamp +Inf to the largest finite value" : ""));
  }
  const bool clamps = repair == Repair::clamp && scan.count_of(kInfiniteValues) > 0;
  const Grid<Rgb> infinite = clamps ? infinite_channels(picture) : Grid<Rgb>();
  if (!scan.clean()) repair_texels(picture, clamps ? scan.brightest : 0.0F);
  map.radiance = texels_of(map, picture);
  const bool is_black = refuse_black(map, scan.brightest);
  if (clamps) {
    if (!is_black) map.notes.push_back(clamp_note(map, scan, infinite));
  } else if (!scan.clean() && repair != Repair::refuse) {
    map.notes.push_back(zero_note(scan));
  }
}

void note_mapping(EnvironmentMap& map) {
  const Extent picture = map.origin.picture.extent;
  const PresetInfo& chosen = info(map.origin.preset);
  const Extent texels = map.radiance.extent();
  if (!map.origin.is_resampled) {
    if (!is_plain(map.mapping)) {
      map.notes.push_back(fmt::format("{} texels of the file's own mapping, {}, each as it is.",
                                      size_text(texels), describe(map.mapping)));
    }
  } else if (chosen.lattice == Lattice::node_centred) {
    map.notes.push_back(fmt::format("{} nodes interpolated bilinearly to {} texels.",
                                    size_text(picture), size_text(texels)));
  } else if (texels != picture) {
    map.notes.push_back(
        fmt::format("{} {} pixels brought to {} texels, nearest pixel each.", size_text(picture),
                    info(own_texels(chosen.preset, picture).mapping.kind).name, size_text(texels)));
  } else if (picture.width % 2 != 0 &&
             (chosen.preset == Preset::pbrt_v3 || chosen.preset == Preset::z_up_half_turn)) {
    map.notes.emplace_back("The width is odd: the half turn moved the columns by half a texel.");
  }
}

bool are_positive(LuminanceWeights weights) {
  return weights.red > 0.0 && weights.green > 0.0 && weights.blue > 0.0;
}

LuminanceWeights weights_of_file(const fs::path& file, const PictureHeader& picture,
                                 std::vector<std::string>& notes) {
  if (!picture.chromaticities) {
    notes.emplace_back("No chromaticities in the header: luminance by the weights of Rec. 709.");
    return kRec709;
  }
  const LuminanceWeights weights = luminance_weights(*picture.chromaticities);
  const std::string primaries = describe(*picture.chromaticities);
  if (!are_positive(weights)) {
    refuse(file,
           fmt::format(
               "the primaries in the header ({}) imply the luminance weights {}: --luminance file "
               "needs positive ones; choose --luminance rec709, or convert the file",
               primaries, describe(weights)));
  }
  notes.push_back(fmt::format("Luminance by the weights {} of the primaries in the header ({}).",
                              describe(weights), primaries));
  return weights;
}

/// Whether RGB is what it is taken for where nothing is said.
bool is_default_space(const PictureHeader& picture) {
  const std::string_view name = name_of(*picture.chromaticities);
  return name.starts_with(kRec709Name) ||
         (name == kRadianceName && picture.format == kRadianceFormat);
}

void choose_weights(const fs::path& file, EnvironmentMap& map, LuminanceChoice choice) {
  const PictureHeader& picture = map.origin.picture;
  if (choice == LuminanceChoice::file) {
    map.weights = weights_of_file(file, picture, map.notes);
    return;
  }
  map.weights = weights_of(choice);
  if (!picture.chromaticities || is_default_space(picture)) return;
  const LuminanceWeights theirs = luminance_weights(*picture.chromaticities);
  map.notes.push_back(fmt::format(
      "The header names primaries ({}): the values were not converted, and luminance is by the "
      "weights {}; those primaries imply {}{}.",
      describe(*picture.chromaticities), describe(map.weights), describe(theirs),
      are_positive(theirs) ? " (--luminance file)" : ", not all positive"));
}

enum class Purpose { sampling, inspection };

EnvironmentMap read_map(const fs::path& file, const ReadOptions& options, Purpose purpose) {
  ImageFile image(file, options.selection, options.allow);
  EnvironmentMap map{.name = file.stem().string(), .radiance = {}};
  map.origin = {.picture = image.header()};
  MapOrigin& origin = map.origin;
  choose_preset(map, options);
  const Extent extent = origin.picture.extent;
  refuse_what_has_no_texel(file, extent, info(origin.preset));
  if (const std::string fault = aspect_fault(extent, info(origin.preset), options.any_aspect);
      !fault.empty()) {
    if (purpose == Purpose::sampling) refuse(file, fault);
    origin.faults.push_back({.kind = "aspect", .message = fault});
    refuse_later(origin, fault);
  }
  Grid<Rgb> picture = image.read_pixels();
  const std::vector<std::string>& header_notes = image.header().notes;
  map.notes.insert(map.notes.begin(), header_notes.begin(), header_notes.end());
  origin.picture.notes.clear();
  choose_weights(file, map, options.luminance);
  origin.is_resampled = options.resample;
  if (!options.resample) map.mapping = own_texels(origin.preset, extent).mapping;
  take_pixels(map, std::move(picture), options.repair);
  if (purpose == Purpose::sampling && !origin.refusal.empty()) refuse(file, origin.refusal);
  note_mapping(map);
  return map;
}

}  // namespace

EnvironmentMap read_environment_map(const fs::path& file, const ReadOptions& options) {
  return read_map(file, options, Purpose::sampling);
}

EnvironmentMap inspect_environment_map(const fs::path& file, const ReadOptions& options) {
  return read_map(file, options, Purpose::inspection);
}

LuminanceWeights weights_of(LuminanceChoice choice) {
  switch (choice) {
    case LuminanceChoice::published:
      return kPublishedLuminance;
    case LuminanceChoice::average:
      return kAverageLuminance;
    case LuminanceChoice::rec709:
    case LuminanceChoice::file:
      break;
  }
  return kRec709;
}

}  // namespace lightproof
