#include "lightproof/image/writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "lightproof/core/atomic_file.h"
#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/image/encoder.h"
#include "lightproof/image/exr_writer.h"

namespace lightproof {
namespace {

void require_finite(const std::filesystem::path& file, const Grid<Rgb>& picture) {
  for (int y = 0; y < picture.extent().height; ++y) {
    for (int x = 0; x < picture.extent().width; ++x) {
      const Rgb rgb = picture(x, y);
      if (std::isfinite(rgb.r) && std::isfinite(rgb.g) && std::isfinite(rgb.b)) continue;
      throw InputError(
          fmt::format("{}: not written: the texel at column {}, row {} is ({}, {}, {}), finite "
                      "values needed",
                      file.string(), x, y, rgb.r, rgb.g, rgb.b));
    }
  }
}

/// NaN becomes 0.
std::uint8_t quantised(float v) {
  return v > 0.0F ? static_cast<std::uint8_t>(std::lround(255.0F * std::min(v, 1.0F)))
                  : std::uint8_t{0};
}

}  // namespace

void write_exr(const std::filesystem::path& file, const Grid<Rgb>& picture) {
  require_finite(file, picture);
  write_file(file, exr_bytes(picture));
}

void write_png(const std::filesystem::path& file, const Grid<Rgb>& picture) {
  write_file(file, png_bytes(picture));
}

std::string png_bytes(const Grid<Rgb>& picture, const Attributes& attributes) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(3 * picture.values().size());
  for (const Rgb rgb : picture.values()) {
    for (const float v : {rgb.r, rgb.g, rgb.b}) pixels.push_back(quantised(v));
  }
  return encode({.format = PictureFormat::png,
                 .channels = {"R", "G", "B"},
                 .levels = {size_of(picture.extent())},
                 .attributes = attributes},
                [&](int /*level*/) { return std::as_bytes(std::span(pixels)); });
}

Grid<Rgb> flip_rows(const Grid<Rgb>& grid) {
  const Extent extent = grid.extent();
  Grid<Rgb> flipped(extent);
  parallel_for(static_cast<std::size_t>(extent.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    std::ranges::copy(grid.row(y), flipped.row(extent.height - 1 - y).begin());
  });
  return flipped;
}

}  // namespace lightproof
