// Environment maps from files. The only place, with writer.h, that knows OpenImageIO.
#pragma once

#include <filesystem>
#include <optional>

#include "lightproof/image/environment_map.h"
#include "lightproof/warp/preset.h"

namespace lightproof {

struct ReadOptions {
  /// How file pixels map to directions; without it the file's own `envmap` attribute decides
  /// (`openexr`), and `z-up` is taken where there is none.
  std::optional<Preset> preset = std::nullopt;
  /// Set negative, NaN and infinite values to 0 and say so in the notes, instead of refusing.
  bool repair = false;
  /// Accept a lat-long image that is not twice as wide as high.
  bool any_aspect = false;
};

/// Reads OpenEXR, Radiance .hdr, or 8-bit PNG/JPEG (decoded by ^2.2; HDR files are linear already)
/// and brings it into the frame of EnvironmentMap. The name is the file's stem.
/// Throws InputError naming file, texel, reason and what would help: missing, unreadable, empty,
/// no R, G, B, NaN, infinite or negative texels (count and first position as column, row from the
/// top of the file), not 2:1, all black.
EnvironmentMap read_environment_map(const std::filesystem::path& file,
                                    const ReadOptions& options = {});

}  // namespace lightproof
