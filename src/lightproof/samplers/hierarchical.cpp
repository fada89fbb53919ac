#include "lightproof/samplers/hierarchical.h"

#include <algorithm>
#include <limits>

#include "lightproof/core/parallel.h"
#include "lightproof/samplers/texel_weights.h"

namespace lightproof {
namespace {

Grid<double> halved(const Grid<double>& fine) {
  const Extent extent = fine.extent();
  Grid<double> coarse =
      Grid<double>::without_values({(extent.width + 1) / 2, (extent.height + 1) / 2});
  parallel_for(static_cast<std::size_t>(coarse.extent().height), [&](std::size_t row) {
    const int top = 2 * static_cast<int>(row);
    const auto sums = coarse.row(static_cast<int>(row));
    std::ranges::fill(sums, 0.0);
    for (int y = top; y < std::min(top + 2, extent.height); ++y) {
      for (int x = 0; x < extent.width; ++x) sums[static_cast<std::size_t>(x) / 2] += fine(x, y);
    }
  });
  return coarse;
}

}  // namespace

Hierarchical::Hierarchical(const EnvironmentMap& map, TargetDensity target)
    : positions_(map.radiance.extent(), target.density_space, map.mapping) {
  std::vector<Grid<double>> pyramid;
  pyramid.push_back(texel_weights(map, target));
  while (pyramid.back().extent().count() > 1) pyramid.push_back(halved(pyramid.back()));
  const double scale =
      static_cast<double>(pyramid.front().extent().count()) / pyramid.back().values().front();
  std::size_t count = 0;
  for (std::size_t k = pyramid.size() - 1; k-- > 0;) {
    const Extent extent = pyramid[k].extent();
    const Extent coarse = pyramid[k + 1].extent();
    levels_.push_back({extent, extent.width > coarse.width, extent.height > coarse.height, count});
    count += extent.count();
  }
  sums_.resize(count);
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    set_sums(levels_[k], pyramid[levels_.size() - 1 - k], scale);
  }
}

void Hierarchical::set_sums(const Level& level, const Grid<double>& sums, double scale) {
  const auto width = static_cast<std::size_t>(level.extent.width);
  parallel_for(static_cast<std::size_t>(level.extent.height), [&](std::size_t row) {
    float* to = sums_.data() + level.first + row * width;
    for (const double sum : sums.row(static_cast<int>(row))) {
      // What has light keeps some.
      const auto least = sum > 0.0 ? std::numeric_limits<float>::min() : 0.0F;
      *to++ = std::max(least, static_cast<float>(scale * sum));
    }
  });
}

PerSquare Hierarchical::pdf(SquarePoint at) const {
  const Extent extent = positions_.extent();
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
  return positions_.pdf(y, mass, at);
}

}  // namespace lightproof
