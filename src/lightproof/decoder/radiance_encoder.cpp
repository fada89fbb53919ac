// Radiance .hdr pictures to files. Not by a library: others have no place for attributes, and round
// down.

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

#include "lightproof/decoder/picture_encoder.h"
#include "lightproof/decoder/radiance_scanlines.h"
#include "lightproof/image/stored_value.h"

namespace lightproof {
namespace {

/// A run of fewer bytes takes no less room than the bytes themselves.
constexpr std::size_t kLeastRun = 3;
/// A code byte counts up to 128 bytes as they are, or 128 plus the length of a run.
constexpr std::size_t kMostBytes = 128;
constexpr std::size_t kMostRun = 127;

using Plane = std::span<const std::uint8_t>;

std::size_t run_length(Plane bytes) {
  const Plane near = bytes.first(std::min(bytes.size(), kMostRun));
  const auto end = std::ranges::find_if(near, [&](std::uint8_t b) { return b != near[0]; });
  return static_cast<std::size_t>(end - near.begin());
}

/// How many bytes come before the next run that is worth coding.
std::size_t literal_length(Plane bytes) {
  std::size_t length = 0;
  while (length < std::min(bytes.size(), kMostBytes) &&
         run_length(bytes.subspan(length)) < kLeastRun) {
    ++length;
  }
  return length;
}

void append(std::string& text, Plane bytes) {
  for (const std::uint8_t byte : bytes) text.push_back(static_cast<char>(byte));
}

void append_plane(std::string& text, Plane bytes) {
  while (!bytes.empty()) {
    std::size_t length = literal_length(bytes);
    if (length > 0) {
      text.push_back(static_cast<char>(length));
      append(text, bytes.first(length));
    } else {
      length = run_length(bytes);
      text.push_back(static_cast<char>(kMostBytes + length));
      text.push_back(static_cast<char>(bytes[0]));
    }
    bytes = bytes.subspan(length);
  }
}

std::string planes_of(const std::vector<RgbePixel>& pixels) {
  const auto length = static_cast<unsigned>(pixels.size());
  std::string text = {2, 2, static_cast<char>(length >> 8U), static_cast<char>(length & 0xffU)};
  std::vector<std::uint8_t> plane(pixels.size());
  for (std::size_t channel = 0; channel < 4; ++channel) {
    std::ranges::transform(pixels, plane.begin(), [&](const RgbePixel& pixel) {
      return channel < 3 ? pixel.mantissas[channel] : pixel.exponent;
    });
    append_plane(text, plane);
  }
  return text;
}

/// No pixel of ours can be taken for a repeat or for the start of planes: in the former all
/// mantissas are 1, and ours is 128 or more in one channel, or all are 0.
std::string plain_pixels(const std::vector<RgbePixel>& pixels) {
  std::string text;
  for (const RgbePixel& pixel : pixels) {
    append(text, pixel.mantissas);
    text.push_back(static_cast<char>(pixel.exponent));
  }
  return text;
}

std::string scanline(std::span<const Rgb> row) {
  std::vector<RgbePixel> pixels(row.size());
  std::ranges::transform(row, pixels.begin(), rgbe_of);
  const bool as_planes = pixels.size() >= kLeastPlane && pixels.size() <= kLongestPlane;
  return as_planes ? planes_of(pixels) : plain_pixels(pixels);
}

/// Readers that descend from Bruce Walter's rgbe.c read lines in pieces of 127 bytes, OpenImageIO
/// in pieces of 128: a line that ends with a piece would leave an empty one, the header's end for
/// them.
std::string header_line(std::string text) {
  while (text.size() % 127 == 0 || text.size() % 128 == 0) text += ' ';
  return text + '\n';
}

/// The header. Its empty line stands right behind FORMAT, as readers that descend from rgbe.c
/// expect.
std::string header(Extent extent, const Attributes& attributes, const Chromaticities& primaries) {
  std::string text = "#?RADIANCE\n";
  for (const Attribute& attribute : attributes) {
    text += header_line(fmt::format("# {}={}", file_name_of(attribute), line_of(attribute)));
  }
  const auto xy = [](const std::array<double, 2>& c) { return fmt::format(" {} {}", c[0], c[1]); };
  text += header_line("PRIMARIES=" + xy(primaries.red) + xy(primaries.green) + xy(primaries.blue) +
                      xy(primaries.white));
  text += "FORMAT=32-bit_rle_rgbe\n\n";
  return text + fmt::format("-Y {} +X {}\n", extent.height, extent.width);
}

}  // namespace

std::string radiance_file(const EncodeRequest& request, const NextSamples& next) {
  const Extent extent = {request.levels.at(0).width, request.levels.at(0).height};
  std::string bytes =
      header(extent, request.attributes, request.chromaticities.value_or(kRec709Space));
  std::vector<Rgb> row(static_cast<std::size_t>(extent.width));
  for (int y = 0; y < extent.height; ++y) {
    next(std::as_writable_bytes(std::span(row)));
    bytes += scanline(row);
  }
  return bytes;
}

}  // namespace lightproof
