// Environment maps from files.
#pragma once

#include <filesystem>
#include <optional>

#include "lightproof/image/environment_map.h"
#include "lightproof/image/texel_faults.h"
#include "lightproof/warp/preset.h"

namespace lightproof {

/// How much red, green and blue count in a map's luminance.
enum class LuminanceChoice {
  rec709,
  published,  ///< the weights that the lecture prints
  average,    ///< a third each
  file,       ///< what the chromaticities in the file's header imply; Rec. 709 where it has none
};

/// How a file is read.
struct ReadOptions {
  /// How file pixels map to directions; without it the file's own `envmap` attribute decides
  /// (`openexr`), and `z-up` is taken where there is none.
  std::optional<Preset> preset = std::nullopt;
  /// What becomes of negative, NaN and infinite values; the notes say what was done.
  Repair repair = Repair::refuse;
  /// Accept a lat-long image that is not twice as wide as high.
  bool any_aspect = false;
  /// What of the file is read.
  ChannelSelection selection = {};
  /// What is read all the same.
  Allowances allow = {};
  LuminanceChoice luminance = LuminanceChoice::rec709;
  /// Bring octahedral pictures, cubes and nodes to texels of latitude and longitude; else a map
  /// keeps the texels of its file.
  bool resample = false;
};

/// Reads OpenEXR, Radiance .hdr, or PNG/JPEG (8 and 16 bits, decoded by ^2.2 or by the gamma that a
/// PNG names; HDR files are linear already) and brings it into the frame of EnvironmentMap. The
/// name is the file's stem.
/// Throws InputError naming file, texel, reason and what would help: missing, unreadable, empty,
/// no R, G, B, NaN, infinite or negative texels (count and first position as column, row from the
/// top of the file), not 2:1, all black; and if decoding crashes, or takes more memory or time than
/// such a picture can.
EnvironmentMap read_environment_map(const std::filesystem::path& file,
                                    const ReadOptions& options = {});

/// Reads a file that is looked at and not sampled, in the way of read_environment_map(), but
/// aspect, faulty texels and blackness do not throw: they stand in the map's origin. Faulty values
/// become 0.
EnvironmentMap inspect_environment_map(const std::filesystem::path& file,
                                       const ReadOptions& options = {});

/// The weights of a choice for a map without chromaticities.
LuminanceWeights weights_of(LuminanceChoice choice);

}  // namespace lightproof
