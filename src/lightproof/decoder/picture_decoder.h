// A picture of one format: what it stores, then its samples.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lightproof/decoder/byte_reader.h"
#include "lightproof/image/decoder_messages.h"
#include "lightproof/image/stored_picture.h"

namespace lightproof {

/// Takes the samples of whole lines.
using TakeRows = std::function<void(std::span<const float>)>;

/// Memory that decoding may take, in bytes, and the samples that it works on, which say how long it
/// may take.
struct DecodingCost {
  std::uint64_t bytes = 0;
  std::uint64_t samples = 0;
};

class PictureDecoder {
 public:
  PictureDecoder() = default;
  virtual ~PictureDecoder() = default;
  PictureDecoder(const PictureDecoder&) = delete;
  PictureDecoder& operator=(const PictureDecoder&) = delete;

  virtual const StoredPicture& picture() const = 0;
  /// What read() may cost, for a picture that has been accepted.
  virtual DecodingCost cost() const = 0;
  /// Hands over all lines, in their order. Throws InputError, or whatever a library throws.
  virtual void read(const ReadRequest& request, const TakeRows& take) = 0;
  /// Sentences on what was passed over after the pixels.
  virtual std::vector<std::string> notes() { return {}; }
};

/// Bytes of the lines that are handed over together.
inline constexpr std::uint64_t kBytesAtOnce = std::uint64_t{1} << 25U;

std::unique_ptr<PictureDecoder> open_exr(ByteReader& bytes, int part);
std::unique_ptr<PictureDecoder> open_radiance(ByteReader& bytes);
std::unique_ptr<PictureDecoder> open_png(ByteReader& bytes);
std::unique_ptr<PictureDecoder> open_jpeg(ByteReader& bytes);

/// The decoder of the format that is asked for. Throws InputError, or whatever a library throws.
std::unique_ptr<PictureDecoder> open_picture(ByteReader& bytes, const OpenRequest& request);

}  // namespace lightproof
