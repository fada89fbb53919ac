#include "lightproof/check/compared_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lightproof {
namespace {

constexpr std::uint64_t kMostCompared = std::uint64_t{1} << 22U;
constexpr int kAround = 8;
const double kBeyond = 1.0 / std::cos(kPi / kAround);

/// Two unit vectors that are perpendicular to a unit vector and to each other.
std::array<Direction, 2> across(Direction d) {
  const Direction other = std::abs(d.z) < 0.5 ? Direction(0.0, 0.0, 1.0) : Direction(1.0, 0.0, 0.0);
  const Direction first = glm::normalize(glm::cross(d, other));
  return {first, glm::cross(d, first)};
}

}  // namespace

void visit_around(Direction d, double rounding, const std::function<void(Direction)>& visit) {
  const auto [first, second] = across(d);
  for (int k = 0; k < kAround; ++k) {
    const double angle = 2.0 * kPi * k / kAround;
    visit(glm::normalize(d + rounding * kBeyond *
                                 (std::cos(angle) * first + std::sin(angle) * second)));
  }
}

void visit_spread(const SampleDump& dump,
                  const std::function<void(std::uint64_t, std::span<const DumpedSample>)>& visit) {
  std::vector<DumpedSample> block(kSampleBlock);
  const std::uint64_t blocks = (dump.count() + kSampleBlock - 1) / kSampleBlock;
  const std::uint64_t step = std::max<std::uint64_t>(1, blocks * kSampleBlock / kMostCompared);
  for (std::uint64_t number = 0; number < blocks; number += step) {
    const std::uint64_t first = number * kSampleBlock;
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(kSampleBlock, dump.count() - first));
    dump.read(first, std::span(block).first(count));
    visit(first, std::span<const DumpedSample>(block).first(count));
  }
}

void ComparedSamples::add(const ComparedCell& cell, double tolerance) {
  if (!(cell.declared > 0.0)) {
    if (found_.unlit_cells++ == 0) found_.first_unlit = cell;
    return;
  }
  const double over = std::abs(found_.add_ratio(cell, mapping_) - 1.0) / tolerance;
  if (over <= 1.0) return;  // false for NaN
  ++found_.cells_off;
  if (found_.worst && !(over > worst_)) return;
  worst_ = over;
  found_.worst = cell;
}

}  // namespace lightproof
