#include "reference/rosenblatt_transform.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "reference/texel_masses.h"

namespace lightproof::reference {
namespace {

/// 0, then the sums so far over the whole; all 0 if the whole is.
template <class Entries>
void write_entries(std::span<const double> masses, Entries&& entries) {
  const double total = std::accumulate(masses.begin(), masses.end(), 0.0);
  double sum = 0.0;
  entries[0] = 0.0;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    sum += masses[i];
    entries[i + 1] = total > 0.0 ? sum / total : 0.0;
  }
}

double between(double low, double high, double share) { return low + (high - low) * share; }

}  // namespace

RosenblattTransform::RosenblattTransform(const Grid<double>& masses, MapMeasure positions)
    : extent_(masses.extent()),
      measure_(positions),
      rows_(static_cast<std::size_t>(extent_.height) + 1),
      columns_(static_cast<std::size_t>(extent_.width) + 1),
      within_({extent_.width + 1, extent_.height}) {
  write_entries(row_marginal(masses), rows_);
  write_entries(column_marginal(masses), columns_);
  for (int y = 0; y < extent_.height; ++y) write_entries(masses.row(y), within_.row(y));
  for (int y = 0; y <= extent_.height; ++y) {
    heights_.push_back(cos_theta(static_cast<double>(y) / extent_.height));
  }
}

RosenblattPoint RosenblattTransform::operator()(SquarePoint at, int x, int y) const {
  return (*this)(at, cos_theta(at.t), x, y);
}

RosenblattPoint RosenblattTransform::operator()(SquarePoint at, double cosine, int x, int y) const {
  const auto column = static_cast<std::size_t>(x);
  const auto row = static_cast<std::size_t>(y);
  const double share_of_cell = std::clamp(at.s * extent_.width - x, 0.0, 1.0);
  const double low = heights_[row];
  const double share_of_row =
      measure_ == MapMeasure::square
          ? std::clamp(at.t * extent_.height - y, 0.0, 1.0)
          : std::clamp((cosine - low) / (heights_[row + 1] - low), 0.0, 1.0);
  return {between(rows_[row], rows_[row + 1], share_of_row),
          between(within_(x, y), within_(x + 1, y), share_of_cell),
          between(columns_[column], columns_[column + 1], share_of_cell),
          y,
          share_of_row,
          share_of_cell};
}

}  // namespace lightproof::reference
