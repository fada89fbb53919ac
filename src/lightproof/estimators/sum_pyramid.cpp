#include "lightproof/estimators/sum_pyramid.h"

#include <algorithm>
#include <utility>

namespace lightproof {

Grid<double> sums_of_quarters(const Grid<double>& cells) {
  const Extent extent = cells.extent();
  Grid<double> sums({(extent.width + 1) / 2, (extent.height + 1) / 2});
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) sums(x / 2, y / 2) += cells(x, y);
  }
  return sums;
}

SumPyramid sum_pyramid(Grid<double> cells) {
  SumPyramid pyramid = {std::move(cells)};
  while (pyramid.back().extent().count() > 1) pyramid.push_back(sums_of_quarters(pyramid.back()));
  std::ranges::reverse(pyramid);
  return pyramid;
}

}  // namespace lightproof
