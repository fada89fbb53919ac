#include "lightproof/points/stratified.h"

namespace lightproof {
namespace {

/// The largest divisor that is not above the square root.
std::uint64_t lesser_divisor(std::uint64_t count) {
  std::uint64_t largest = 1;
  for (std::uint64_t divisor = 1; divisor * divisor <= count; ++divisor) {
    if (count % divisor == 0) largest = divisor;
  }
  return largest;
}

}  // namespace

StratifiedPoints::StratifiedPoints(std::uint64_t count, PointSeed seed)
    : rows_(lesser_divisor(count)),
      columns_(count / rows_),
      stream_("points/stratified", seed.value_or(0)) {
  assert(count >= 1 && count <= kMostPoints);
}

}  // namespace lightproof
