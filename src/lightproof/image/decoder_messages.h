// What the libraries and lightproof-decode say to each other: messages over a socket, each a head,
// as it lies in memory (both are one build on one machine), and so many bytes: a value of
// core/serialise.h, or samples.
//
//   open     → picture                 what the file on descriptor 3 stores
//   read     → rows …, done            its samples, line by line, as floats
//   encode, values … → file            the bytes of a new file
//
// Each may be answered by `failed` instead. Private to the image module and to the decoder.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "lightproof/core/enumeration.h"
#include "lightproof/image/attribute.h"
#include "lightproof/image/chromaticities.h"

namespace lightproof {

enum class MessageKind : std::uint32_t {
  open,     ///< an OpenRequest
  read,     ///< a ReadRequest
  encode,   ///< an EncodeRequest
  values,   ///< samples of one level, row by row
  picture,  ///< a StoredPicture
  rows,     ///< samples of whole lines, floats, channel by channel within each pixel
  done,     ///< notes, a list of sentences
  file,     ///< the bytes of the file
  failed,   ///< a DecoderFailure
};

struct MessageHead {
  MessageKind kind = MessageKind::failed;
  std::uint32_t unused = 0;
  std::uint64_t bytes = 0;
};

/// Beyond it a message that is no samples and no file is taken for nonsense.
inline constexpr std::uint64_t kLongestValue = std::uint64_t{1} << 24U;

enum class PictureFormat { openexr, radiance, png, jpeg };
template <>
inline constexpr std::size_t kValuesOf<PictureFormat> = 4;

struct OpenRequest {
  std::string version = {};  ///< of whoever asks
  PictureFormat format = PictureFormat::openexr;
  int part = 0;
  static auto fields(auto& r) { return std::tie(r.version, r.format, r.part); }
};

struct ReadRequest {
  std::vector<std::string> channels = {};  ///< as the file names them, in the order of the samples
  /// Luminance and chroma become R, G and B; the channels are not named.
  bool from_luminance_chroma = false;
  static auto fields(auto& r) { return std::tie(r.channels, r.from_luminance_chroma); }
};

struct LevelSize {
  int width = 0;
  int height = 0;
  static auto fields(auto& l) { return std::tie(l.width, l.height); }
};

/// A file to be made. OpenEXR and Radiance take floats, PNG bytes.
struct EncodeRequest {
  std::string version = {};
  PictureFormat format = PictureFormat::openexr;
  std::vector<std::string> channels = {};
  std::vector<LevelSize> levels = {};  ///< one, or the levels of an OpenEXR file of tiles
  int tile = 0;                        ///< pixels of a side; 0 for lines
  Attributes attributes = {};
  std::optional<Chromaticities> chromaticities = {};
  static auto fields(auto& r) {
    return std::tie(r.version, r.format, r.channels, r.levels, r.tile, r.attributes,
                    r.chromaticities);
  }
};

struct DecoderFailure {
  bool is_memory = false;   ///< the file asks for more than a picture of its size can need
  std::string reason = {};  ///< complete, but for the file's name
  static auto fields(auto& f) { return std::tie(f.is_memory, f.reason); }
};

}  // namespace lightproof
