// The pixels of a Radiance picture, scanline by scanline, each in whichever of three ways it is
// stored: four runs-coded planes of bytes (since 1991; a scanline starts with 2, 2 and its length),
// pixels of which (1, 1, 1, n) repeats the one before (the coding until then), or plain pixels.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lightproof/decoder/byte_reader.h"
#include "lightproof/decoder/radiance_header.h"
#include "lightproof/image/stored_value.h"

namespace lightproof {

/// Shorter and longer scanlines are never stored as planes.
inline constexpr std::size_t kLeastPlane = 8;
inline constexpr std::size_t kLongestPlane = 32767;

/// How many bytes the pixels take at least, in whichever coding.
std::uint64_t least_bytes(const RadianceResolution& resolution);

/// Decodes a picture's scanlines, one after the other.
class RadianceScanlines {
 public:
  /// `bytes` stand at the first scanline, and outlive this.
  RadianceScanlines(ByteReader& bytes, const RadianceResolution& resolution);

  /// The next scanline; valid until the next call. Throws InputError with scanline and byte if the
  /// file ends first, or a run has no length, goes past the end or repeats nothing.
  std::span<const RgbePixel> next();

 private:
  [[noreturn]] void fail(std::string_view reason) const;
  std::uint8_t next_byte();
  RgbePixel next_pixel();
  /// Decodes a scanline of the newer coding, all four planes of it.
  void read_planes();
  void read_plane(std::span<std::uint8_t> plane);
  /// Decodes a scanline of the older coding or of plain pixels, whose first pixel is read already.
  void read_pixels(RgbePixel first);

  ByteReader* bytes_;
  int scanline_ = -1;
  int scanlines_;
  std::vector<RgbePixel> pixels_;
  std::vector<std::uint8_t> plane_;
};

}  // namespace lightproof
