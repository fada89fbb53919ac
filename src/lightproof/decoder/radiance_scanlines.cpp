#include "lightproof/decoder/radiance_scanlines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lightproof/decoder/refusal.h"

namespace lightproof {
namespace {

/// A byte above it says that the next one is repeated, so often as it is larger.
constexpr unsigned kRun = 128;
constexpr unsigned kLastShift = 24;

/// A normalised pixel has a mantissa of 128 or more, or is (0, 0, 0, 0).
bool is_repeat(RgbePixel pixel) { return pixel.mantissas == std::array<std::uint8_t, 3>{1, 1, 1}; }

/// The first four bytes of a scanline of planes.
bool starts_planes(RgbePixel first, std::size_t pixels) {
  return first.mantissas[0] == 2 && first.mantissas[1] == 2 && first.mantissas[2] < kRun &&
         pixels >= kLeastPlane && pixels <= kLongestPlane;
}

}  // namespace

std::uint64_t least_bytes(const RadianceResolution& resolution) {
  // The older coding: a pixel, then repeats of 255, 255 * 256, …. Planes take more: 12 bytes and
  // up.
  std::uint64_t bytes = 4;
  std::uint64_t reached = 1;
  for (std::uint64_t count = 255; reached < static_cast<std::uint64_t>(resolution.pixels);
       count *= 256) {
    reached += count;
    bytes += 4;
  }
  return bytes * static_cast<std::uint64_t>(resolution.scanlines);
}

RadianceScanlines::RadianceScanlines(ByteReader& bytes, const RadianceResolution& resolution)
    : bytes_(&bytes),
      scanlines_(resolution.scanlines),
      pixels_(static_cast<std::size_t>(resolution.pixels)),
      plane_(pixels_.size()) {}

std::span<const RgbePixel> RadianceScanlines::next() {
  ++scanline_;
  const RgbePixel first = next_pixel();
  if (!starts_planes(first, pixels_.size())) {
    read_pixels(first);
    return pixels_;
  }
  const std::size_t length = 256 * std::size_t{first.mantissas[2]} + first.exponent;
  if (length != pixels_.size()) {
    fail(fmt::format("it says that it has {} pixels, {} needed", length, pixels_.size()));
  }
  read_planes();
  return pixels_;
}

void RadianceScanlines::fail(std::string_view reason) const {
  refuse(fmt::format(
      "cannot be read as Radiance .hdr: scanline {} of {} (counted from 0), before byte {}: {}",
      scanline_, scanlines_, bytes_->position(), reason));
}

std::uint8_t RadianceScanlines::next_byte() {
  const std::optional<std::uint8_t> byte = bytes_->next();
  if (!byte) fail("the file ends early");
  return *byte;
}

RgbePixel RadianceScanlines::next_pixel() {
  std::array<std::uint8_t, 4> bytes{};
  if (!bytes_->read(bytes)) fail("the file ends early");
  return {{bytes[0], bytes[1], bytes[2]}, bytes[3]};
}

void RadianceScanlines::read_planes() {
  for (std::size_t plane = 0; plane < 4; ++plane) {
    read_plane(plane_);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      (plane < 3 ? pixels_[i].mantissas[plane] : pixels_[i].exponent) = plane_[i];
    }
  }
}

void RadianceScanlines::read_plane(std::span<std::uint8_t> plane) {
  while (!plane.empty()) {
    const unsigned code = next_byte();
    const std::size_t count = code > kRun ? code - kRun : code;
    if (count == 0) fail("a run of no bytes");
    if (count > plane.size()) {
      fail(fmt::format("a run of {} bytes goes past the scanline's end, which is {} away", count,
                       plane.size()));
    }
    if (code > kRun) {
      std::ranges::fill(plane.first(count), next_byte());
    } else if (!bytes_->read(plane.first(count))) {
      fail("the file ends early");
    }
    plane = plane.subspan(count);
  }
}

void RadianceScanlines::read_pixels(RgbePixel first) {
  if (is_repeat(first))
    fail("it starts with a repeat (1, 1, 1, n), and there is nothing to repeat");
  pixels_[0] = first;
  unsigned shift = 0;
  for (std::size_t done = 1; done < pixels_.size();) {
    const RgbePixel pixel = next_pixel();
    if (!is_repeat(pixel)) {
      pixels_[done++] = pixel;
      shift = 0;
      continue;
    }
    if (shift > kLastShift) fail("more than four repeats follow each other");
    const std::size_t count = std::size_t{pixel.exponent} << shift;
    if (count > pixels_.size() - done) {
      fail(fmt::format("a run of {} pixels goes past the scanline's end, which is {} away", count,
                       pixels_.size() - done));
    }
    std::fill_n(pixels_.begin() + static_cast<std::ptrdiff_t>(done), count, pixels_[done - 1]);
    done += count;
    shift += 8;
  }
}

}  // namespace lightproof
