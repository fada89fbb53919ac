#include "lightproof/image/exr_writer.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "lightproof/image/open_image_io_encode.h"

namespace lightproof {
namespace {

constexpr int kTile = 64;

OIIO::ImageSpec spec_of(Extent extent, int channels, const Attributes& attributes) {
  OIIO::ImageSpec spec(extent.width, extent.height, channels, OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "");  // the same picture gives the same bytes
  for (const Attribute& attribute : attributes) {
    spec.attribute(file_name_of(attribute), line_of(attribute));
  }
  return spec;
}

void add(OIIO::ImageSpec& spec, const std::optional<Chromaticities>& chromaticities) {
  if (!chromaticities) return;
  std::array<float, 8> values{};
  std::size_t at = 0;
  for (const auto& xy :
       {chromaticities->red, chromaticities->green, chromaticities->blue, chromaticities->white}) {
    for (const double value : xy) values[at++] = static_cast<float>(value);
  }
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), values.data());
}

OIIO::ImageSpec mipmap_spec(const MapLevels& map, int level) {
  const Extent extent = level_extent(map.extent(), level);
  OIIO::ImageSpec spec = spec_of(extent, 3, attributes_of(map));
  add(spec, map.chromaticities);
  spec.tile_width = kTile;
  spec.tile_height = kTile;
  spec.tile_depth = 1;
  spec.attribute("textureformat", "Plain Texture");  // asks for levels
  spec.attribute("wrapmodes", "periodic,clamp");
  return spec;
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
  OIIO::ImageSpec spec = spec_of(picture.extent(), 3, attributes);
  add(spec, chromaticities);
  return encode("openexr", spec, picture.values().data());
}

std::string exr_mipmap_bytes(const MapLevels& map) {
  assert(is_pyramid(map) && map.projection == Projection::lat_long);
  Grid<Rgb> rest;
  return encode_exr_levels(most_levels(map.extent()), [&](int level) -> EncodedLevel {
    const auto index = static_cast<std::size_t>(level);
    const bool is_given = index < map.levels.size();
    if (!is_given) rest = halved(index == map.levels.size() ? map.levels.back().faces[0] : rest);
    const Grid<Rgb>& picture = is_given ? map.levels[index].faces[0] : rest;
    return {mipmap_spec(map, level), picture.values().data()};
  });
}

std::string exr_bytes(const BrdfMap& map) {
  OIIO::ImageSpec spec = spec_of(map.values.extent(), 2, attributes_of(map));
  spec.channelnames = {"R", "G"};
  return encode("openexr", spec, map.values.values().data());
}

}  // namespace lightproof
