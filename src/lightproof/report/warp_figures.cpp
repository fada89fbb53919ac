#include "lightproof/report/warp_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"

namespace lightproof {
namespace {

constexpr double kWidth = 320.0;  // units of the drawing
constexpr double kHeight = kWidth / 2.0;

/// From blue over grey to orange, along the columns of the grid.
std::string column_colour(int column, int columns) {
  const double share = (column + 0.5) / columns;
  const auto mixed = [&](double a, double b) {
    return static_cast<int>(std::lround(std::lerp(a, b, share)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mixed(0x00, 0xe8), mixed(0x5a, 0x6a),
                     mixed(0xc8, 0x00));
}

/// A path of dots, one a row of the grid.
std::string column_path(const WarpGrid& grid, int column) {
  std::string path;
  for (int row = 0; row < grid.side; ++row) {
    const SquarePoint p = grid.points[static_cast<std::size_t>(row * grid.side + column)];
    path += fmt::format("M{:.1f} {:.1f}h.01", p.s * kWidth, (1.0 - p.t) * kHeight);
  }
  return fmt::format("<path d=\"{}\" stroke=\"{}\"/>", path, column_colour(column, grid.side));
}

std::string figure(const WarpGrid& grid) {
  std::string paths;
  for (int column = 0; column < grid.side; ++column) paths += column_path(grid, column);
  return fmt::format(
      "<figure><svg class=\"warp\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">{}</svg>\n"
      "<figcaption><strong>{} table ({})</strong><br>neighbours end up {}\u00b0 apart on "
      "average</figcaption></figure>\n",
      kWidth, kHeight,
      escaped(fmt::format("Where {} takes a grid of {} by {} points on {}", grid.sampler, grid.side,
                          grid.side, grid.map)),
      paths, grid.is_monotone ? "Monotone" : "Alias", escaped(grid.sampler),
      format_number(grid.neighbour_degrees, 2));
}

std::string pair_of(const std::vector<WarpGrid>& grids, const std::string& map) {
  std::string html;
  for (const WarpGrid& grid : grids) {
    if (grid.map == map) html += figure(grid);
  }
  return fmt::format("<h4>{}</h4>\n<div class=\"renders three\">\n{}</div>\n", escaped(map), html);
}

constexpr std::string_view kNote =
    "A grid of 31\u00d731 points of the unit square, where the table takes them on the map (zenith "
    "at the top); the colour tells the column of the grid, from blue to orange. A monotone table "
    "bends the grid, and neighbours stay neighbours: what was spread evenly stays so where the "
    "light is. An alias table draws the same density, and tears the grid apart: one of the two "
    "numbers chooses the texel, so that a column of the grid falls on one texel and its alias.";

}  // namespace

std::string warp_finding(const std::vector<WarpGrid>& grids) {
  double least = HUGE_VAL;
  double most = 0.0;
  for (const WarpGrid& alias : grids) {
    for (const WarpGrid& monotone : grids) {
      if (alias.is_monotone || !monotone.is_monotone || alias.map != monotone.map) continue;
      const double ratio = alias.neighbour_degrees / monotone.neighbour_degrees;
      least = std::min(least, ratio);
      most = std::max(most, ratio);
    }
  }
  const std::string low = format_number(least, 2);
  const std::string high = format_number(most, 2);
  return fmt::format(
      "An alias table takes neighbouring points {} times as far apart as a monotone table",
      low == high ? low : low + " to " + high);
}

std::string warp_figures(const std::vector<WarpGrid>& grids) {
  if (grids.empty()) return "";
  std::vector<std::string> maps;
  for (const WarpGrid& grid : grids) maps.push_back(grid.map);
  maps = unique_names(maps);
  std::string others;
  for (std::size_t i = 1; i < maps.size(); ++i) others += pair_of(grids, maps[i]);
  return fmt::format("<h3>{}</h3>\n", escaped(warp_finding(grids))) + pair_of(grids, maps[0]) +
         paragraph(kNote, "note") +
         (others.empty() ? "" : collapsible("The same on the other maps", others));
}

}  // namespace lightproof
