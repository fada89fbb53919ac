#include "lightproof/image/exr_writer.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>
#include <vector>

#include "lightproof/image/encoder.h"

namespace lightproof {
namespace {

constexpr int kTile = 64;
const std::vector<std::string> kRgb = {"R", "G", "B"};

template <class Value>
std::span<const std::byte> bytes_of(const Grid<Value>& picture) {
  return std::as_bytes(picture.values());
}

/// The picture at half the size, rounded down: the means of 2 x 2 texels, or of what there is of
/// them.
Grid<Rgb> halved(const Grid<Rgb>& picture) {
  const Extent from = picture.extent();
  Grid<Rgb> small(level_extent(from, 1));
  for (int y = 0; y < small.extent().height; ++y) {
    for (int x = 0; x < small.extent().width; ++x) {
      const int right = std::min(2 * x + 1, from.width - 1);
      const int below = std::min(2 * y + 1, from.height - 1);
      const auto sum = glm::dvec3(picture(2 * x, 2 * y)) + glm::dvec3(picture(right, 2 * y)) +
                       glm::dvec3(picture(2 * x, below)) + glm::dvec3(picture(right, below));
      small(x, y) = Rgb(0.25 * sum);
    }
  }
  return small;
}

}  // namespace

std::string exr_bytes(const Grid<Rgb>& picture, const Attributes& attributes,
                      const std::optional<Chromaticities>& chromaticities) {
  return encode({.format = PictureFormat::openexr,
                 .channels = kRgb,
                 .levels = {size_of(picture.extent())},
                 .attributes = attributes,
                 .chromaticities = chromaticities},
                [&](int /*level*/) { return bytes_of(picture); });
}

std::string exr_mipmap_bytes(const MapLevels& map) {
  assert(is_pyramid(map) && map.projection == Projection::lat_long);
  EncodeRequest request = {.format = PictureFormat::openexr,
                           .channels = kRgb,
                           .tile = kTile,
                           .attributes = attributes_of(map),
                           .chromaticities = map.chromaticities};
  for (int level = 0; level < most_levels(map.extent()); ++level) {
    request.levels.push_back(size_of(level_extent(map.extent(), level)));
  }
  Grid<Rgb> rest;
  return encode(std::move(request), [&](int level) {
    const auto index = static_cast<std::size_t>(level);
    const bool is_given = index < map.levels.size();
    if (!is_given) rest = halved(index == map.levels.size() ? map.levels.back().faces[0] : rest);
    return bytes_of(is_given ? map.levels[index].faces[0] : rest);
  });
}

std::string exr_bytes(const BrdfMap& map) {
  return encode({.format = PictureFormat::openexr,
                 .channels = {"R", "G"},
                 .levels = {size_of(map.values.extent())},
                 .attributes = attributes_of(map)},
                [&](int /*level*/) { return bytes_of(map.values); });
}

}  // namespace lightproof
