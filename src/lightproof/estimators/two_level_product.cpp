#include "lightproof/estimators/two_level_product.h"

#include <algorithm>

#include "lightproof/estimators/cell_cdf.h"
#include "lightproof/estimators/tabulated_source.h"
#include "lightproof/estimators/texel_directions.h"
#include "lightproof/samplers/texel_positions.h"
#include "lightproof/samplers/texel_weights.h"

namespace lightproof {
namespace {

constexpr int kMostBlocks = TwoLevelProduct::kMostBlocks;
constexpr int kNodes = TwoLevelProduct::kNodes;
constexpr double kDefensiveShare = TwoLevelProduct::kDefensiveShare;

/// The map's light by blocks, rows inside of blocks, and texels inside of these.
class Blocks {
 public:
  explicit Blocks(const EnvironmentMap& map)
      : extent_(map.radiance.extent()),
        blocks_{std::min(kMostBlocks, extent_.width), std::min(kMostBlocks, extent_.height)},
        texels_(texel_weights(map, on_map({DensitySpace::solid_angle}, map))),
        rows_({extent_.height, blocks_.width}),
        light_(blocks_),
        positions_(extent_, DensitySpace::solid_angle),
        nodes_(cell_size(nodes_of(blocks_)), 0.5, nodes_of(blocks_)) {
    for (int j = 0; j < blocks_.height; ++j) {
      for (int i = 0; i < blocks_.width; ++i) sum_up(i, j);
    }
  }

  std::size_t bytes() const {
    return texels_.values().size_bytes() + rows_.values().size_bytes() +
           light_.values().size_bytes() + positions_.bytes() + nodes_.bytes();
  }

  /// The blocks in proportion to their light times the mean of k.
  CellCdf table(const Material& material, const ShadingPoint& at) const {
    Grid<double> weights(blocks_);
    std::array<double, static_cast<std::size_t>(kNodes * kMostBlocks)> memory;
    const auto k = std::span(memory).first(static_cast<std::size_t>(nodes_.columns()));
    for (int row = 0; row < nodes_.rows(); ++row) {
      nodes_.reflected(material, at, row, k);
      for (int x = 0; x < nodes_.columns(); ++x) {
        weights(x / kNodes, row / kNodes) += k[static_cast<std::size_t>(x)] / (kNodes * kNodes);
      }
    }
    double sum = 0.0;
    double light = 0.0;
    for (std::size_t i = 0; i < weights.values().size(); ++i) {
      sum += weights.values()[i] * light_.values()[i];
      light += light_.values()[i];
    }
    const double least = sum > 0.0 ? kDefensiveShare * sum / light : 1.0;
    for (std::size_t i = 0; i < weights.values().size(); ++i) {
      weights.values()[i] = (weights.values()[i] + least) * light_.values()[i];
    }
    return CellCdf(std::move(weights));
  }

  LightSample sample(const CellCdf& product, SquarePoint u) const {
    const TexelDraw block = product.draw(u);
    const auto first_row = static_cast<std::size_t>(begin(block.y, blocks_.height, extent_.height));
    const auto end_row =
        static_cast<std::size_t>(begin(block.y + 1, blocks_.height, extent_.height));
    const auto rows = rows_.row(block.x).subspan(first_row, end_row - first_row);
    const FoundCell row = find_cell(rows, 0.0, block.row_fraction);
    const int y = static_cast<int>(first_row + row.index);
    const auto first = static_cast<std::size_t>(begin(block.x, blocks_.width, extent_.width));
    const auto end = static_cast<std::size_t>(begin(block.x + 1, blocks_.width, extent_.width));
    const auto texels = texels_.row(y).subspan(first, end - first);
    const FoundCell texel = find_cell(texels, 0.0, block.column_fraction);
    const double mass = block.mass * (row.width / rows.back()) * (texel.width / texels.back());
    return positions_.direction(
        {static_cast<int>(first + texel.index), y, texel.rest, row.rest, mass});
  }

 private:
  static Extent nodes_of(Extent blocks) { return {kNodes * blocks.width, kNodes * blocks.height}; }
  /// Where a block begins along one side of the map.
  static int begin(int block, int blocks, int texels) { return block * texels / blocks; }

  /// Makes cumulative sums of the weights of one block.
  void sum_up(int i, int j) {
    double all = 0.0;
    for (int y = begin(j, blocks_.height, extent_.height);
         y < begin(j + 1, blocks_.height, extent_.height); ++y) {
      double sum = 0.0;
      for (int x = begin(i, blocks_.width, extent_.width);
           x < begin(i + 1, blocks_.width, extent_.width); ++x) {
        texels_(x, y) = sum += texels_(x, y);
      }
      rows_(y, i) = all += sum;
    }
    light_(i, j) = all;
  }

  Extent extent_;
  Extent blocks_;
  Grid<double> texels_;  ///< cumulative in each row of a block
  Grid<double> rows_;    ///< cumulative over the rows of a block; [column of blocks][row of texels]
  Grid<double> light_;   ///< of each block
  TexelPositions positions_;
  TexelDirections nodes_;
};

}  // namespace

PreparedSource two_level_product_source(const EnvironmentMap& map) {
  return tabulated_source<Blocks>(map);
}

}  // namespace lightproof
