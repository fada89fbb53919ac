#include "lightproof/gate/discrete_sampler.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>
#include <span>

namespace lightproof {
namespace {

/// Cumulative shares; 1 from the last positive weight on.
void accumulate_shares(std::span<const double> weights, std::span<double> sums) {
  std::inclusive_scan(weights.begin(), weights.end(), sums.begin());
  const double total = sums.back();
  if (total > 0.0) {
    for (double& sum : sums) sum /= total;
  }
}

/// The first of so many cells from `cell` on whose sum lies above u, or the last of them; chosen
/// without branches, as in search_by_bisection.
std::size_t bisect(std::span<const double> sums, std::size_t cell, std::size_t cells, double u) {
  while (cells > 1) {
    const std::size_t half = cells / 2;
    cell += sums[cell + half - 1] <= u ? half : 0;
    cells -= half;
  }
  return cell;
}

struct Cell {
  int index;
  double fraction;
};

Cell find_cell(std::span<const double> sums, const ShareGuide& guide, double u) {
  const std::size_t index = guide.find(sums, u);
  const double low = index == 0 ? 0.0 : sums[index - 1];
  return {static_cast<int>(index), (u - low) / (sums[index] - low)};
}

}  // namespace

ShareGuide::ShareGuide(std::span<const double> sums) {
  const std::size_t parts = std::bit_ceil(sums.size());
  std::size_t cell = 0;
  for (std::size_t part = 0; part <= parts; ++part) {
    const double u = static_cast<double>(part) / static_cast<double>(parts);
    while (cell + 1 < sums.size() && sums[cell] <= u) ++cell;
    first_.push_back(static_cast<std::uint32_t>(cell));
  }
}

std::size_t ShareGuide::find(std::span<const double> sums, double u) const {
  const std::size_t parts = first_.size() - 1;
  const double scaled = u * static_cast<double>(parts);
  const std::size_t part =
      scaled < static_cast<double>(parts) ? static_cast<std::size_t>(scaled) : parts - 1;
  return bisect(sums, first_[part], first_[part + 1] - first_[part] + std::size_t{1}, u);
}

DiscreteSampler::DiscreteSampler(Grid<double> masses, MapMeasure positions, const Mapping& mapping)
    : masses_(std::move(masses)),
      positions_(masses_.extent(), positions, mapping),
      rows_(static_cast<std::size_t>(masses_.extent().height)),
      columns_(masses_.extent()) {
  std::vector<double> row_masses;
  for (int y = 0; y < extent().height; ++y) {
    const auto row = masses_.row(y);
    row_masses.push_back(std::accumulate(row.begin(), row.end(), 0.0));
    accumulate_shares(row, columns_.row(y));
    guides_.emplace_back(columns_.row(y));
  }
  accumulate_shares(row_masses, rows_);
  guides_.emplace_back(rows_);
  median_ = sample({0.5, 0.5});
}

TexelSample DiscreteSampler::sample(SquarePoint u) const {
  const Cell row = find_cell(rows_, guides_.back(), u.t);
  const Cell column =
      find_cell(columns_.row(row.index), guides_[static_cast<std::size_t>(row.index)], u.s);
  return positions_.sample(
      {column.index, row.index, column.fraction, row.fraction, masses_(column.index, row.index)});
}

PerSquare DiscreteSampler::pdf(SquarePoint at) const {
  const int y = cell_of(at.t, extent().height);
  return positions_.pdf(y, masses_(cell_of(at.s, extent().width), y), at);
}

std::size_t DiscreteSampler::table_bytes() const {
  const std::size_t guides =
      std::transform_reduce(guides_.begin(), guides_.end(), std::size_t{0}, std::plus<>(),
                            [](const ShareGuide& guide) { return guide.bytes(); });
  return guides + (2 * masses_.values().size() + rows_.size()) * sizeof(double);
}

static_assert(EnvSampler<DiscreteSampler>);

}  // namespace lightproof
