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

bool has_nodes(Preset preset) { return info(preset).lattice == Lattice::node_centred; }

}  // namespace

Extent map_extent(Preset preset, Extent picture) {
  if (has_nodes(preset)) return {picture.width - 1, picture.height - 1};
  if (is_square(preset)) return {2 * picture.width, picture.height};
  return picture;
}

Grid<Rgb> map_from_picture(Preset preset, const Grid<Rgb>& picture) {
  const Extent extent = map_extent(preset, picture.extent());
  assert(extent.width >= 1 && extent.height >= 1);
  if (has_nodes(preset)) return interpolated(preset, picture, extent);
  if (is_square(preset)) return nearest(preset, picture, extent);
  return permuted(preset, picture);
}

PicturePlace place_in_picture(Preset preset, Extent picture, int column, int row) {
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
