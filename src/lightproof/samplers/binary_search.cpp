#include "lightproof/samplers/binary_search.h"

#include <algorithm>

namespace lightproof {

int search_by_bisection(CdfKnots knots, std::uint32_t u) {
  const auto upper = std::upper_bound(knots.begin() + 1, knots.end(), u);
  return static_cast<int>(upper - knots.begin()) - 1;
}

static_assert(EnvSampler<BinarySearch>);

}  // namespace lightproof
