#include "lightproof/stability/published_row.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace lightproof {
namespace {

constexpr std::uint32_t kNumbers = 1U << 24U;

/// The average of a row as the listing computes it.
float average_of(std::span<const float> weights) {
  float sum = 0.0F;
  for (const float weight : weights) sum += weight;
  return sum / static_cast<float>(weights.size());
}

}  // namespace

PublishedRow::PublishedRow(std::vector<float> weights) : weights_(std::move(weights)) {
  const float average = average_of(weights_);
  const auto columns = static_cast<float>(weights_.size());
  float sum = 0.0F;
  double exact = 0.0;
  for (const float weight : weights_) {
    sum += weight / average / columns;
    sums_.push_back(sum);
    exact += static_cast<double>(weight);
    exact_.push_back(exact);
  }
  for (double& value : exact_) value /= exact;
}

PublishedRow::Stop PublishedRow::stop(std::uint32_t k) const {
  const float u = static_cast<float>(k) * 0x1p-24F;
  // A comparison with what is not a number is false, so that the scan goes on.
  const auto at = std::find_if(sums_.begin(), sums_.end(), [u](float sum) { return sum >= u; });
  const auto index = static_cast<std::size_t>(at - sums_.begin());
  const float previous = index > 0 ? sums_[index - 1] : 0.0F;
  const float sum = index < sums_.size() ? sums_[index] : sums_.back();
  const float before = index < sums_.size() ? previous : sum;
  return {static_cast<int>(index), (u - before) / (sum - before)};
}

float PublishedRow::position(std::uint32_t k) const {
  const Stop at = stop(k);
  return (static_cast<float>(at.index) + at.fraction) / static_cast<float>(count());
}

double PublishedRow::largest_error() const {
  double largest = 0.0;
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    largest = std::max(largest, std::abs(static_cast<double>(sums_[i]) - exact_[i]));
  }
  return largest;
}

double PublishedRow::misplaced() const {
  // Both are step functions of the random number: the measure of where they differ, from one of
  // their steps to the next.
  double share = 0.0;
  double from = 0.0;
  std::size_t i = 0;
  std::size_t j = 0;
  while (from < 1.0) {
    const double to_float = i < sums_.size() ? std::min(static_cast<double>(sums_[i]), 1.0) : 1.0;
    const double to_exact = j < exact_.size() ? exact_[j] : 1.0;
    const double to = std::max(from, std::min(to_float, to_exact));
    if (i != j) share += to - from;
    from = to;
    if (i >= sums_.size() && j >= exact_.size()) break;
    if (to_float <= to_exact && i < sums_.size())
      ++i;
    else
      ++j;
  }
  return share;
}

int PublishedRow::reachable(std::uint32_t first, std::uint32_t last) const {
  int reached = 0;
  // The largest number that is led to the texels so far.
  double before = static_cast<double>(first) - 1.0;
  for (const float sum : sums_) {
    const double upto =
        std::min(std::floor(static_cast<double>(sum) * 0x1p24), static_cast<double>(last));
    if (upto > before) ++reached;
    before = std::max(before, upto);
  }
  return reached;
}

double PublishedRow::falls_off() const {
  return std::max(0.0, 1.0 - static_cast<double>(sums_.back()));
}

bool PublishedRow::misses_last_number() const { return !(sums_.back() >= 1.0F - 0x1p-24F); }

double PublishedRow::lands_in_neighbour() const {
  std::uint32_t displaced = 0;
  std::size_t index = 0;
  for (std::uint32_t k = 0; k < kNumbers; ++k) {
    const float u = static_cast<float>(k) * 0x1p-24F;
    while (index < sums_.size() && !(sums_[index] >= u)) ++index;
    if (index >= sums_.size()) break;
    const float before = index > 0 ? sums_[index - 1] : 0.0F;
    const float fraction = (u - before) / (sums_[index] - before);
    const float position = (static_cast<float>(index) + fraction) / static_cast<float>(count());
    const auto texel = static_cast<std::size_t>(position * static_cast<float>(count()));
    if (texel != index) ++displaced;
  }
  return static_cast<double>(displaced) / kNumbers;
}

double unreachable_by_flat_sum(int width) {
  const std::uint64_t texels =
      static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(width) / 2;
  const float mass = 1.0F / static_cast<float>(texels);
  float sum = 0.0F;
  std::uint64_t unreachable = 0;
  for (std::uint64_t i = 0; i < texels; ++i) {
    const float next = sum + mass;
    if (next == sum) ++unreachable;
    sum = next;
  }
  return static_cast<double>(unreachable) / static_cast<double>(texels);
}

}  // namespace lightproof
