#include "lightproof/recommend/light_nodes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// The size of a node, relative to the lobe's width or its distance.
constexpr double kRelativeSize = 1.0 / 5.0;
/// Parts of a texel along either side, at most.
constexpr int kMostParts = 16;
/// A block is looked at texel by texel if it has more than this share of all light, and such a
/// texel in parts: where hardly anything but a sun shines, all variance is that of k across it.
constexpr double kBrightBlock = 5e-3;
constexpr double kBrightTexel = 2e-3;
constexpr int kBrightParts = 4;

/// Adds nodes to those of one point.
class Collector {
 public:
  Collector(const MapSummary& summary, const LobeReach& lobe, LightNodes& nodes)
      : summary_(&summary), lobe_(&lobe), nodes_(&nodes), texels_(summary.finest.extent()) {}

  void add(const LightBlock& block) {
    const bool bright = is_bright(block);
    const double size = size_at(block.centre, 0.71 * block.width);
    if (!bright && block.width <= size) return add_cells(block);
    // Groups of texels of about this size; the parts of single ones see to it themselves.
    const double height = kPi / texels_.height;
    const double t = 0.5 * (block.y0 + block.y1) / texels_.height;
    const double width = 2.0 * kPi * sin_theta(t) / texels_.width;
    const int rows = bright ? 1 : std::max(1, static_cast<int>(size / height));
    const int columns = bright ? 1 : std::max(1, static_cast<int>(size / width));
    for (int y = block.y0; y < block.y1; y += rows) {
      for (int x = block.x0; x < block.x1; x += columns) {
        if (rows * columns == 1) {
          add_texel(block, x, y);
        } else {
          add_group(block, {x, std::min(x + columns, block.x1), y, std::min(y + rows, block.y1)});
        }
      }
    }
  }

 private:
  bool is_bright(const LightBlock& block) const {
    double light = 0.0;
    for (std::size_t i = block.first_cell; i < block.end_cell; ++i) {
      light += summary_->cells.light[i];
    }
    return light > kBrightBlock * summary_->light;
  }

  /// The size that nodes may have within a radius of a direction.
  double size_at(Direction d, double radius) const {
    if (std::isinf(lobe_->extent.width)) return lobe_->extent.width;
    const double angle = std::acos(std::clamp(glm::dot(d, lobe_->extent.axis), -1.0, 1.0));
    return kRelativeSize * std::max(lobe_->extent.width, angle - radius - lobe_->margin);
  }

  void add_cells(const LightBlock& block) {
    const LightCells& cells = summary_->cells;
    const auto append = [&](auto& to, const auto& from) {
      to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(block.first_cell),
                from.begin() + static_cast<std::ptrdiff_t>(block.end_cell));
    };
    append(nodes_->x, cells.x);
    append(nodes_->y, cells.y);
    append(nodes_->z, cells.z);
    append(nodes_->solid_angle, cells.solid_angle);
    append(nodes_->light, cells.light);
    append(nodes_->square, cells.square);
    for (std::size_t i = 0; i < kTableDensities; ++i) append(nodes_->second[i], cells.second[i]);
    append(nodes_->product, cells.product);
    append(nodes_->quadrant, cells.quadrant);
  }

  /// Columns x0 … x1 - 1 and rows y0 … y1 - 1.
  struct Group {
    int x0, x1;
    int y0, y1;
  };

  double mean_square_of(int x, int y) const {
    const auto luminance = static_cast<double>(summary_->finest(x, y));
    return summary_->finest_square.extent().count() > 0
               ? static_cast<double>(summary_->finest_square(x, y))
               : luminance * luminance;
  }

  /// Texels as one node, where their light is.
  void add_group(const LightBlock& block, const Group& group) {
    double solid_angle = 0.0;
    double light = 0.0;
    double square = 0.0;
    std::array<double, kTableDensities> second = {};
    double s = 0.0;
    double t = 0.0;
    for (int y = group.y0; y < group.y1; ++y) {
      const double area = texel_solid_angle(texels_, y);
      for (int x = group.x0; x < group.x1; ++x) {
        const auto luminance = static_cast<double>(summary_->finest(x, y));
        solid_angle += area;
        if (!(luminance > 0.0)) continue;
        light += area * luminance;
        square += area * mean_square_of(x, y);
        s += area * luminance * (x + 0.5);
        t += area * luminance * (y + 0.5);
        const std::size_t cell = cell_of_texel(block, luminance);
        const double share = area * luminance / summary_->cells.light[cell];
        for (std::size_t k = 0; k < kTableDensities; ++k) {
          second[k] += share * summary_->cells.second[k][cell];
        }
      }
    }
    const double column = light > 0.0 ? s / light : 0.5 * (group.x0 + group.x1);
    const double row = light > 0.0 ? t / light : 0.5 * (group.y0 + group.y1);
    push(direction_from_square({column / texels_.width, row / texels_.height}),
         static_cast<int>(column), static_cast<int>(row), {solid_angle, light, square, second});
  }

  void add_texel(const LightBlock& block, int x, int y) {
    const double t = (y + 0.5) / texels_.height;
    const double area = texel_solid_angle(texels_, y);
    const Direction centre = direction_from_square({(x + 0.5) / texels_.width, t});
    const double height = kPi / texels_.height;
    const double width = 2.0 * kPi * sin_theta(t) / texels_.width;
    const double size = size_at(centre, 0.0);
    const auto luminance = static_cast<double>(summary_->finest(x, y));
    const int least = area * luminance > kBrightTexel * summary_->light ? kBrightParts : 1;
    const auto parts = [size, least](double side) {
      return static_cast<int>(std::clamp(std::ceil(side / size), 1.0 * least, 1.0 * kMostParts));
    };
    const int rows = parts(height);
    const int columns = parts(width);
    const double mean_square = mean_square_of(x, y);
    std::array<double, kTableDensities> second = {};
    if (luminance > 0.0) {
      const std::size_t cell = cell_of_texel(block, luminance);
      for (std::size_t k = 0; k < kTableDensities; ++k) {
        second[k] =
            area * luminance / summary_->cells.light[cell] * summary_->cells.second[k][cell];
      }
    }
    for (int j = 0; j < rows; ++j) {
      const double at = (y + (j + 0.5) / rows) / texels_.height;
      const double part = sin_theta(at) / (sin_theta(t) * rows * columns);
      std::array<double, kTableDensities> of_part;
      for (std::size_t k = 0; k < kTableDensities; ++k) of_part[k] = part * second[k];
      for (int i = 0; i < columns; ++i) {
        const Direction d =
            rows * columns == 1
                ? centre
                : direction_from_square({(x + (i + 0.5) / columns) / texels_.width, at});
        push(d, x, y, {part * area, part * area * luminance, part * area * mean_square, of_part});
      }
    }
  }

  /// What is summed up of a node.
  struct Sums {
    double solid_angle;
    double light;
    double square;
    std::array<double, kTableDensities> second;
  };

  /// A node at a direction in a texel.
  void push(Direction d, int x, int y, const Sums& sums) {
    nodes_->x.push_back(d.x);
    nodes_->y.push_back(d.y);
    nodes_->z.push_back(d.z);
    nodes_->solid_angle.push_back(sums.solid_angle);
    nodes_->light.push_back(sums.light);
    nodes_->square.push_back(sums.square);
    for (std::size_t k = 0; k < kTableDensities; ++k) nodes_->second[k].push_back(sums.second[k]);
    nodes_->product.push_back(summary_->product_index.of(x, y));
    nodes_->quadrant.push_back(summary_->quadrant_index.of(x, y));
  }

  /// The cell of a block that holds texels as bright as this.
  std::size_t cell_of_texel(const LightBlock& block, double luminance) const {
    const int octave = std::ilogb(luminance * kSphere / summary_->light);
    std::size_t cell = block.first_cell;
    if (!(summary_->cells.light[cell] > 0.0)) ++cell;
    while (cell + 1 < block.end_cell && summary_->cells.octave[cell] < octave) ++cell;
    return cell;
  }

  const MapSummary* summary_;
  const LobeReach* lobe_;
  LightNodes* nodes_;
  Extent texels_;
};

}  // namespace

LobeReach lobe_of(const Material& material, const ShadingPoint& at) {
  // Tables of prefiltered maps have texels of up to a 256th of a turn.
  const double margin = std::holds_alternative<ModifiedPhong>(material) ? kPi / 256.0 : 0.0;
  return {lobe_at(material, at), margin};
}

LightNodes nodes_for(const MapSummary& summary, const LobeReach& lobe, Direction normal,
                     Direction also) {
  LightNodes nodes;
  Collector collector(summary, lobe, nodes);
  for (const LightBlock& block : summary.blocks) {
    const double reach = -std::sin(std::min(0.71 * block.width, 1.5));
    if (glm::dot(block.centre, normal) > reach ||
        (also != Direction{0.0, 0.0, 0.0} && glm::dot(block.centre, also) > reach)) {
      collector.add(block);
    }
  }
  return nodes;
}

}  // namespace lightproof
