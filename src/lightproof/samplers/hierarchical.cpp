#include "lightproof/samplers/hierarchical.h"

#include <algorithm>
#include <limits>

#include "lightproof/samplers/texel_weights.h"

namespace lightproof {
namespace {

Grid<double> halved(const Grid<double>& fine) {
  const Extent extent = fine.extent();
  Grid<double> coarse({(extent.width + 1) / 2, (extent.height + 1) / 2});
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) coarse(x / 2, y / 2) += fine(x, y);
  }
  return coarse;
}

}  // namespace

Hierarchical::Hierarchical(const EnvironmentMap& map, TargetDensity target)
    : places_(map.radiance.extent(), target.weighting) {
  std::vector<Grid<double>> pyramid;
  pyramid.push_back(texel_weights(map, target));
  while (pyramid.back().extent().count() > 1) pyramid.push_back(halved(pyramid.back()));
  const double scale =
      static_cast<double>(pyramid.front().extent().count()) / pyramid.back().values().front();
  for (std::size_t k = pyramid.size() - 1; k-- > 0;) {
    const Extent extent = pyramid[k].extent();
    const Extent coarse = pyramid[k + 1].extent();
    levels_.push_back(
        {extent, extent.width > coarse.width, extent.height > coarse.height, sums_.size()});
    for (const double sum : pyramid[k].values()) {
      // What has light keeps some.
      const auto least = sum > 0.0 ? std::numeric_limits<float>::min() : 0.0F;
      sums_.push_back(std::max(least, static_cast<float>(scale * sum)));
    }
  }
}

PerSquare Hierarchical::pdf(SquarePoint at) const {
  const Extent extent = places_.extent();
  const int x = cell_of(at.s, extent.width);
  const int y = cell_of(at.t, extent.height);
  double mass = 1.0;
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    const auto finer = static_cast<int>(levels_.size() - k);
    const Children children = children_of(levels_[k], x >> finer, y >> finer);
    const double* const sums = children.sum[(y >> (finer - 1)) - children.y];
    const double row = sums[0] + sums[1];
    if (!(row > 0.0)) return {0.0};
    const double all =
        children.sum[0][0] + children.sum[0][1] + children.sum[1][0] + children.sum[1][1];
    mass *= row / all * (sums[(x >> (finer - 1)) - children.x] / row);
  }
  return places_.pdf(y, mass, at);
}

}  // namespace lightproof
