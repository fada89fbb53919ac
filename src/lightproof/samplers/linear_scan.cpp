#include "lightproof/samplers/linear_scan.h"

namespace lightproof {

int search_by_scan(CdfKnots knots, std::uint32_t u) {
  std::size_t cell = 0;
  while (knots[cell + 1] <= u) ++cell;
  return static_cast<int>(cell);
}

static_assert(EnvSampler<LinearScan>);

}  // namespace lightproof
