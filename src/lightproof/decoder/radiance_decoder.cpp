// Radiance .hdr pictures: pixels as they are stored, exposure and colour correction left in.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "lightproof/decoder/picture_decoder.h"
#include "lightproof/decoder/radiance_header.h"
#include "lightproof/decoder/radiance_scanlines.h"
#include "lightproof/decoder/refusal.h"

namespace lightproof {
namespace {

const std::vector<std::string> kChannels = {"R", "G", "B"};

StoredPicture stored_picture(const RadianceHeader& radiance) {
  StoredPicture stored;
  const Extent extent = radiance.resolution.extent();
  stored.data = {.width = extent.width, .height = extent.height};
  stored.display = stored.data;
  for (const std::string& name : kChannels) stored.channels.push_back({.name = name});
  stored.holds_xyz = radiance.holds_xyz;
  // Primaries say nothing of X, Y and Z.
  if (!radiance.holds_xyz) stored.chromaticities = radiance.primaries;
  const RadianceResolution& r = radiance.resolution;
  stored.order = {r.columns, r.scanlines_backwards, r.pixels_backwards};
  if (stored.order != StoredOrder()) stored.order_text = r.text();
  stored.exposure = radiance.exposure;
  stored.notes = notes_of(radiance);
  return stored;
}

class RadianceDecoder : public PictureDecoder {
 public:
  explicit RadianceDecoder(ByteReader& bytes)
      : bytes_(bytes), radiance_(read_radiance_header(bytes)), stored_(stored_picture(radiance_)) {
    const RadianceResolution& r = radiance_.resolution;
    const std::uint64_t least = least_bytes(r);
    const std::uint64_t found = bytes.size() - bytes.position();
    if (found >= least) return;
    refuse(
        fmt::format("the file is cut off or its header is damaged: {} scanlines of {} pixels take "
                    "at least {} bytes, and the file has {}",
                    r.scanlines, r.pixels, least, found));
  }

  const StoredPicture& picture() const override { return stored_; }
  DecodingCost cost() const override {
    return {.bytes = 0, .samples = 3 * radiance_.resolution.extent().count()};
  }

  void read(const ReadRequest& request, const TakeRows& take) override {
    const RadianceResolution& r = radiance_.resolution;
    std::vector<std::size_t> channels;
    for (const std::string& name : request.channels) {
      channels.push_back(
          static_cast<std::size_t>(std::ranges::find(kChannels, name) - kChannels.begin()) % 3);
    }
    const std::size_t of_line = channels.size() * static_cast<std::size_t>(r.pixels);
    const std::size_t at_once = std::max<std::size_t>(1, kBytesAtOnce / (4 * of_line));
    RadianceScanlines scanlines(bytes_, r);
    std::vector<float> rows(std::min(at_once, static_cast<std::size_t>(r.scanlines)) * of_line);
    std::size_t filled = 0;
    for (int line = 0; line < r.scanlines; ++line) {
      for (const RgbePixel& pixel : scanlines.next()) {
        const Rgb rgb = rgb_of(pixel);
        for (const std::size_t channel : channels) rows[filled++] = rgb[static_cast<int>(channel)];
      }
      if (filled < rows.size() && line + 1 < r.scanlines) continue;
      take(std::span(rows).first(filled));
      filled = 0;
    }
  }

  std::vector<std::string> notes() override {
    const std::uint64_t rest = bytes_.size() - bytes_.position();
    if (rest == 0) return {};
    return {fmt::format("{} bytes after the picture were ignored.", rest)};
  }

 private:
  ByteReader& bytes_;
  RadianceHeader radiance_;
  StoredPicture stored_;
};

}  // namespace

std::unique_ptr<PictureDecoder> open_radiance(ByteReader& bytes) {
  return std::make_unique<RadianceDecoder>(bytes);
}

}  // namespace lightproof
