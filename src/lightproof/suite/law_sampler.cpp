#include "lightproof/suite/law_sampler.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "lightproof/warp/lat_long.h"

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

Cell find_cell(std::span<const double> sums, double u) {
  const auto upper = std::upper_bound(sums.begin(), sums.end(), u);
  const auto index =
      std::min<std::ptrdiff_t>(upper - sums.begin(), static_cast<std::ptrdiff_t>(sums.size()) - 1);
  const double low = index == 0 ? 0.0 : sums[static_cast<std::size_t>(index) - 1];
  return {static_cast<int>(index), (u - low) / (sums[static_cast<std::size_t>(index)] - low)};
}

}  // namespace

LawSampler::LawSampler(Grid<double> masses, Weighting weighting)
    : masses_(std::move(masses)),
      weighting_(weighting),
      solid_angle_rows_(masses_.extent().height),
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

TexelSample LawSampler::sample(SquarePoint u) const {
  const Cell row = find_cell(rows_, u.t);
  const Cell column = find_cell(columns_.row(row.index), u.s);
  const double t = weighting_ == Weighting::A
                       ? place_in_cell(row.index, row.fraction, extent().height)
                       : solid_angle_rows_.place(row.index, row.fraction);
  const SquarePoint at = {place_in_cell(column.index, column.fraction, extent().width), t};
  return {at, column.index, row.index, pdf(at)};
}

PerSquare LawSampler::pdf(SquarePoint at) const {
  const int y = cell_of(at.t, extent().height);
  const double mass = masses_(cell_of(at.s, extent().width), y);
  if (weighting_ == Weighting::A) return {mass * static_cast<double>(extent().count())};
  return to_square(PerSteradian{mass / texel_solid_angle(extent(), y)}, at);
}

std::size_t LawSampler::table_bytes() const {
  return (2 * masses_.values().size() + rows_.size()) * sizeof(double);
}

static_assert(EnvSampler<LawSampler>);

}  // namespace lightproof
