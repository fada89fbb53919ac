#include "lightproof/samplers/cdf_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "lightproof/core/parallel.h"
#include "lightproof/samplers/texel_weights.h"
#include "lightproof/samplers/weight_vectors.h"

namespace lightproof {

namespace {

/// CDF entries are summed in units of 2^-20 of theirs, and rounded at the end.
constexpr unsigned kFractionBits = 20;
/// Weights that are summed while they are in the nearest cache.
constexpr std::size_t kBlock = 512;

}  // namespace

double quantise_cdf(std::span<const double> weights, std::span<std::uint32_t> entries,
                    std::uint32_t one) {
  entries[0] = 0;
  const WeightSums sums(weights);
  const double total = sums.sum();
  if (!(total > 0.0)) {
    std::ranges::fill(entries, 0U);
    return total;
  }
  const auto shared = static_cast<double>(one - static_cast<std::uint32_t>(sums.positive()));
  // Whole numbers, so that their sums are exact; the shares' ends within half a unit of `one`, and
  // is rounded to it.
  constexpr std::int64_t kUnit = std::int64_t{1} << kFractionBits;
  const FixedPoint form = {std::ldexp(shared, kFractionBits) / total, 0, kUnit};
  std::int64_t sum = kUnit / 2;
  std::array<std::int64_t, kBlock> shares;
  for (std::size_t first = 0; first < weights.size(); first += kBlock) {
    const auto block = weights.subspan(first, std::min(kBlock, weights.size() - first));
    to_fixed_point(block, form, std::span(shares).first(block.size()));
    for (std::size_t i = 0; i < block.size(); ++i) {
      sum += shares[i];
      entries[first + i + 1] = static_cast<std::uint32_t>(sum >> kFractionBits);
    }
  }
  return total;
}

/// weigh(y, weights) writes the weights of a row.
template <class Weigh>
void CdfTable::fill(const Weigh& weigh) {
  const std::size_t stride = entries_of(extent_.width);
  rows_.resize(entries_of(extent_.height) + kEntriesAfter);
  columns_.resize(stride * static_cast<std::size_t>(extent_.height) + kEntriesAfter);
  std::fill_n(columns_.end() - kEntriesAfter, kEntriesAfter, 0U);
  std::vector<double> row_weights(static_cast<std::size_t>(extent_.height));
  parallel_for(row_weights.size(), [&](std::size_t row) {
    const auto width = static_cast<std::size_t>(extent_.width);
    const auto memory = std::make_unique_for_overwrite<double[]>(width);
    const std::span<double> weights(memory.get(), width);
    weigh(static_cast<int>(row), weights);
    row_weights[row] = quantise_cdf(weights, {columns_.data() + row * stride, stride});
  });
  quantise_cdf(row_weights, std::span(rows_).first(entries_of(extent_.height)));
}

CdfTable::CdfTable(const EnvironmentMap& map, TargetDensity target)
    : extent_(map.radiance.extent()) {
  fill([&](int y, std::span<double> weights) { weigh_row(map, target, y, weights); });
  if (rows().back() == 0) refuse_black(map);
}

CdfTable::CdfTable(const Grid<double>& weights) : extent_(weights.extent()) {
  fill([&](int y, std::span<double> row) { std::ranges::copy(weights.row(y), row.begin()); });
}

}  // namespace lightproof
