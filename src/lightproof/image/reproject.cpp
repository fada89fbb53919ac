#include "lightproof/image/reproject.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <vector>

#include "lightproof/core/parallel.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// Texel centres land on the edge between two pixels where a convention turns an odd number of
/// columns by half a turn. This much of a pixel, far above the rounding of s * width and far below
/// half a pixel, sends all of them to the same side, so that no pixel is used twice.
constexpr double kTieBreak = 1e-6;

double centre(int index, int count) { return (index + 0.5) / count; }

int pixel(double coordinate, int count) {
  return static_cast<int>(std::floor(coordinate * count + kTieBreak)) % count;
}

void for_each_row(Extent extent, const std::function<void(int)>& body) {
  parallel_for(static_cast<std::size_t>(extent.height),
               [&](std::size_t row) { body(static_cast<int>(row)); });
}

/// Image coordinates of the texel centres. In a lat-long convention s depends on the column alone
/// and t on the row alone, so one line through the map gives each.
struct ImageLines {
  std::vector<double> s;
  std::vector<double> t;
};

ImageLines image_lines(Preset preset, Extent map) {
  ImageLines lines;
  for (int x = 0; x < map.width; ++x) {
    const Direction d = direction_from_square({centre(x, map.width), 0.5});
    lines.s.push_back(image_from_direction(preset, d).s);
  }
  for (int y = 0; y < map.height; ++y) {
    const Direction d = direction_from_square({0.25, centre(y, map.height)});
    lines.t.push_back(image_from_direction(preset, d).t);
  }
  return lines;
}

Grid<Rgb> permuted(Preset preset, const Grid<Rgb>& picture) {
  const Extent extent = picture.extent();
  const ImageLines lines = image_lines(preset, extent);
  std::vector<int> columns;
  for (const double s : lines.s) columns.push_back(pixel(s, extent.width));
  const bool same_columns = std::ranges::is_sorted(columns);

  Grid<Rgb> map(extent);
  for_each_row(extent, [&](int y) {
    const auto from = picture.row(extent.height - 1 - pixel(lines.t[y], extent.height));
    const auto to = map.row(y);
    if (same_columns) {
      std::ranges::copy(from, to.begin());
    } else {
      std::ranges::transform(columns, to.begin(), [&](int column) { return from[column]; });
    }
  });
  return map;
}

Grid<Rgb> nearest(Preset preset, const Grid<Rgb>& picture, Extent extent) {
  const int width = picture.extent().width;
  const int height = picture.extent().height;
  Grid<Rgb> map(extent);
  for_each_row(extent, [&](int y) {
    for (int x = 0; x < extent.width; ++x) {
      const Direction d =
          direction_from_square({centre(x, extent.width), centre(y, extent.height)});
      const SquarePoint at = image_from_direction(preset, d);
      map(x, y) = picture(pixel(at.s, width), height - 1 - pixel(at.t, height));
    }
  });
  return map;
}

/// A place between the nodes `index` and `index` + 1, `weight` of the way.
struct Between {
  int index;
  float weight;
};

Between between(double coordinate, int nodes) {
  const double position = coordinate * (nodes - 1);
  const int index = std::clamp(static_cast<int>(position), 0, nodes - 2);
  return {index, static_cast<float>(position - index)};
}

Grid<Rgb> interpolated(Preset preset, const Grid<Rgb>& picture, Extent extent) {
  const int width = picture.extent().width;
  const int height = picture.extent().height;
  const ImageLines lines = image_lines(preset, extent);
  Grid<Rgb> map(extent);
  for_each_row(extent, [&](int y) {
    const Between row = between(1.0 - lines.t[y], height);
    for (int x = 0; x < extent.width; ++x) {
      const Between column = between(lines.s[x], width);
      const auto along = [&](int r) {
        return glm::mix(picture(column.index, r), picture(column.index + 1, r), column.weight);
      };
      map(x, y) = glm::mix(along(row.index), along(row.index + 1), row.weight);
    }
  });
  return map;
}

bool is_square(Preset preset) { return info(preset).aspect == 1.0; }

constexpr int kFaces = 6;

/// Whether the faces of a cube stand below each other.
bool is_column(Extent picture) { return picture.height == kFaces * picture.width; }

/// The faces of a cube, in a picture with row 0 at its top.
Grid<Rgb> side_by_side(const Grid<Rgb>& picture) {
  if (!is_column(picture.extent())) return picture;
  const int size = picture.extent().width;
  Grid<Rgb> strip({kFaces * size, size});
  for (int y = 0; y < strip.extent().height; ++y) {
    for (int x = 0; x < strip.extent().width; ++x) {
      strip(x, y) = picture(x % size, x / size * size + y);
    }
  }
  return strip;
}

bool has_nodes(Preset preset) { return info(preset).lattice == Lattice::node_centred; }

}  // namespace

Extent map_extent(Preset preset, Extent picture) {
  if (has_nodes(preset)) return {picture.width - 1, picture.height - 1};
  if (is_square(preset)) return {2 * picture.width, picture.height};
  if (preset == Preset::cube) {
    const int face = std::min(picture.width, picture.height);
    return {4 * face, 2 * face};
  }
  return picture;
}

Grid<Rgb> map_from_picture(Preset preset, const Grid<Rgb>& picture) {
  const Extent extent = map_extent(preset, picture.extent());
  assert(extent.width >= 1 && extent.height >= 1);
  if (has_nodes(preset)) return interpolated(preset, picture, extent);
  if (is_square(preset)) return nearest(preset, picture, extent);
  if (preset == Preset::cube) return nearest(preset, side_by_side(picture), extent);
  return permuted(preset, picture);
}

OwnTexels own_texels(Preset preset, Extent picture) {
  if (has_nodes(preset)) {
    const Extent texels = {picture.width - 1, picture.height};
    return {node_mapping(texels), texels};
  }
  if (is_square(preset)) return {{MappingKind::octahedral}, picture};
  if (preset == Preset::cube) {
    const int face = std::min(picture.width, picture.height);
    return {{MappingKind::cube_strip}, {kFaces * face, face}};
  }
  const double half_texel = picture.width % 2 != 0 ? 0.5 / picture.width : 0.0;
  if (preset == Preset::z_up_half_turn) return {{.shift = half_texel}, picture};
  if (preset == Preset::pbrt_v3) return {{.shift = -half_texel}, picture};
  return {{}, picture};
}

Grid<Rgb> own_texels_of(Preset preset, const Grid<Rgb>& picture) {
  const OwnTexels own = own_texels(preset, picture.extent());
  if (own.mapping.kind == MappingKind::lat_long) return permuted(preset, picture);
  const Grid<Rgb> strip = preset == Preset::cube ? side_by_side(picture) : picture;
  Grid<Rgb> map(own.extent);
  for_each_row(own.extent, [&](int y) {
    std::ranges::copy(strip.row(own.extent.height - 1 - y).first(map.row(y).size()),
                      map.row(y).begin());
  });
  return map;
}

PicturePixel own_pixel_in_picture(Preset preset, Extent picture, int column, int row) {
  const OwnTexels own = own_texels(preset, picture);
  if (own.mapping.kind == MappingKind::lat_long) {
    return pixel_in_picture(preset, picture, column, row);
  }
  const int from_top = own.extent.height - 1 - row;
  if (preset != Preset::cube || !is_column(picture)) return {column, from_top};
  const int size = picture.width;
  return {column % size, column / size * size + from_top};
}

PicturePixel pixel_in_picture(Preset preset, Extent picture, int column, int row) {
  const Extent map = map_extent(preset, picture);
  const Direction d = direction_from_square({centre(column, map.width), centre(row, map.height)});
  const SquarePoint at = image_from_direction(preset, d);
  if (has_nodes(preset)) {
    return {static_cast<int>(std::lround(at.s * (picture.width - 1))),
            static_cast<int>(std::lround((1.0 - at.t) * (picture.height - 1)))};
  }
  return {pixel(at.s, picture.width), picture.height - 1 - pixel(at.t, picture.height)};
}

}  // namespace lightproof
