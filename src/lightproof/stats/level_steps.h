// The clearest step between the levels of a series: the statistic of stats/change_points.h.
#pragma once

#include <cstddef>
#include <span>

namespace lightproof {

/// A step from one level of a series to the next.
struct LevelStep {
  std::size_t first = 0;   ///< index in the series of the first value of the new level
  double statistic = 0.0;  ///< difference of the means over its standard error
};

/// The clearest step between neighbouring levels fitted to the values, of which there are at least
/// two times kShortestLevel. There are up to three levels, and of n values up to n/24 + 1.
LevelStep clearest_step(std::span<const double> values);

}  // namespace lightproof
