// The pixels of a Radiance picture, scanline by scanline, each in whichever of three ways it is
// stored: four runs-coded planes of bytes (since 1991; a scanline starts with 2, 2 and its length),
// pixels of which (1, 1, 1, n) repeats the one before (the coding until then), or plain pixels.
// Private to the image module.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lightproof/image/byte_reader.h"
#include "lightproof/image/radiance_header.h"

namespace lightproof {

/// Shorter and longer scanlines are never stored as planes.
inline constexpr std::size_t kLeastPlane = 8;
inline constexpr std::size_t kLongestPlane = 32767;

/// Mantissas and the common exponent.
struct RgbePixel {
  std::array<std::uint8_t, 3> mantissas;
  std::uint8_t exponent;
};

/// mantissa / 256 * 2^(exponent - 128), exactly; black for an exponent of 0. This is what
/// OpenImageIO and most renderers read; Radiance itself adds half a step to the mantissas.
Rgb rgb_of(RgbePixel pixel);

/// The bytes without which no coding can store the picture.
std::uint64_t least_bytes(const RadianceResolution& resolution);

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
  /// The newer coding, of all four planes.
  void read_planes();
  void read_plane(std::span<std::uint8_t> plane);
  /// The older coding and plain pixels, of which the first is read already.
  void read_pixels(RgbePixel first);

  ByteReader* bytes_;
  int scanline_ = -1;
  int scanlines_;
  std::vector<RgbePixel> pixels_;
  std::vector<std::uint8_t> plane_;
};

}  // namespace lightproof
