#include "lightproof/recommend/predicted_products.h"

#include <utility>

#include "lightproof/estimators/hierarchical_product.h"
#include "lightproof/estimators/sum_pyramid.h"
#include "lightproof/estimators/two_level_product.h"

namespace lightproof {
namespace {

Extent nodes_of(const MapSummary& summary) {
  const Extent blocks = summary.product_light.extent();
  return {TwoLevelProduct::kNodes * blocks.width, TwoLevelProduct::kNodes * blocks.height};
}

CellSize quadrant_size(const MapSummary& summary) {
  return {summary.quadrant_side / summary.extent.width,
          summary.quadrant_side / summary.extent.height};
}

/// The probabilities of the squares of the last level: that of a square is its parent's times its
/// share of the quarters' products of light and mean k. `k` is integrated over the squares.
Grid<double> masses_of_squares(const std::vector<Grid<double>>& k,
                               const std::vector<Grid<double>>& light,
                               const std::vector<Grid<double>>& area) {
  Grid<double> mass({1, 1}, 1.0);
  for (std::size_t level = 1; level < k.size(); ++level) {
    const Extent extent = light[level].extent();
    Grid<double> products(extent);
    for (std::size_t i = 0; i < extent.count(); ++i) {
      products.values()[i] =
          k[level].values()[i] * light[level].values()[i] / area[level].values()[i];
    }
    const Grid<double> sums = sums_of_quarters(products);
    Grid<double> finer(extent);
    for (int y = 0; y < extent.height; ++y) {
      for (int x = 0; x < extent.width; ++x) {
        const double all = sums(x / 2, y / 2);
        if (all > 0.0) finer(x, y) = mass(x / 2, y / 2) * products(x, y) / all;
      }
    }
    mass = std::move(finer);
  }
  return mass;
}

}  // namespace

PredictedProducts::PredictedProducts(const MapSummary& summary, const Material& material)
    : summary_(&summary),
      material_(material),
      nodes_(cell_size(nodes_of(summary)), 0.5, nodes_of(summary)),
      quadrant_centres_(quadrant_size(summary), 0.5, summary.quadtree_light.back().extent()) {}

std::vector<double> PredictedProducts::two_level_scales(const ShadingPoint& at) const {
  const Grid<double>& light = summary_->product_light;
  constexpr int kNodes = TwoLevelProduct::kNodes;
  Grid<double> weights(light.extent());
  std::vector<double> k(static_cast<std::size_t>(nodes_.columns()));
  for (int row = 0; row < nodes_.rows(); ++row) {
    nodes_.reflected(material_, at, row, k);
    for (int x = 0; x < nodes_.columns(); ++x) {
      weights(x / kNodes, row / kNodes) += k[static_cast<std::size_t>(x)] / (kNodes * kNodes);
    }
  }
  const auto values = weights.values();
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * light.values()[i];
  const double least = sum > 0.0 ? TwoLevelProduct::kDefensiveShare * sum / summary_->light : 1.0;
  double whole = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    whole += (values[i] + least) * light.values()[i];
  }
  std::vector<double> scales(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) scales[i] = whole / (values[i] + least);
  return scales;
}

std::vector<double> PredictedProducts::quadrant_scales(const ShadingPoint& at) const {
  const std::vector<Grid<double>>& light = summary_->quadtree_light;
  const std::vector<Grid<double>>& area = summary_->quadtree_area;
  Grid<double> finest(light.back().extent());
  double sum = 0.0;
  for (int y = 0; y < finest.extent().height; ++y) {
    quadrant_centres_.reflected(material_, at, y, finest.row(y));
    for (int x = 0; x < finest.extent().width; ++x) sum += finest(x, y) * light.back()(x, y);
  }
  const double least =
      sum > 0.0 ? HierarchicalProduct::kDefensiveShare * sum / summary_->light : 1.0;
  for (std::size_t i = 0; i < finest.values().size(); ++i) {
    finest.values()[i] = (finest.values()[i] + least) * area.back().values()[i];
  }
  const Grid<double> mass = masses_of_squares(sum_pyramid(std::move(finest)), light, area);
  std::vector<double> scales(mass.values().size());
  for (std::size_t i = 0; i < scales.size(); ++i) {
    if (mass.values()[i] > 0.0) scales[i] = light.back().values()[i] / mass.values()[i];
  }
  return scales;
}

}  // namespace lightproof
