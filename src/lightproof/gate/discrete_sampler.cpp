#include "lightproof/gate/discrete_sampler.h"

#include <algorithm>
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

struct Cell {
  int index;
  double fraction;
};

/// The first cell whose sum lies above u, chosen without branches, as in search_by_bisection.
Cell find_cell(std::span<const double> sums, double u) {
  const double* sum = sums.data();
  for (std::size_t cells = sums.size(); cells > 1;) {
    const std::size_t half = cells / 2;
    sum += sum[half - 1] <= u ? half : 0;
    cells -= half;
  }
  const auto index = static_cast<int>(sum - sums.data());
  const double low = index == 0 ? 0.0 : sum[-1];
  return {index, (u - low) / (*sum - low)};
}

}  // namespace

DiscreteSampler::DiscreteSampler(Grid<double> masses, DensitySpace density_space)
    : masses_(std::move(masses)),
      positions_(masses_.extent(), density_space),
      rows_(static_cast<std::size_t>(masses_.extent().height)),
      columns_(masses_.extent()) {
  std::vector<double> row_masses;
  for (int y = 0; y < extent().height; ++y) {
    const auto row = masses_.row(y);
    row_masses.push_back(std::accumulate(row.begin(), row.end(), 0.0));
    accumulate_shares(row, columns_.row(y));
  }
  accumulate_shares(row_masses, rows_);
  median_ = sample({0.5, 0.5});
}

TexelSample DiscreteSampler::sample(SquarePoint u) const {
  const Cell row = find_cell(rows_, u.t);
  const Cell column = find_cell(columns_.row(row.index), u.s);
  return positions_.sample(column.index, row.index, column.fraction, row.fraction,
                           masses_(column.index, row.index));
}

PerSquare DiscreteSampler::pdf(SquarePoint at) const {
  const int y = cell_of(at.t, extent().height);
  return positions_.pdf(y, masses_(cell_of(at.s, extent().width), y), at);
}

std::size_t DiscreteSampler::table_bytes() const {
  return (2 * masses_.values().size() + rows_.size()) * sizeof(double);
}

static_assert(EnvSampler<DiscreteSampler>);

}  // namespace lightproof
