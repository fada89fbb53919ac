#include "reference/rosenblatt_transform.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "reference/texel_masses.h"

namespace lightproof::reference {
namespace {

/// 0, then the sums so far over the whole; all 0 if the whole is.
std::vector<double> entries_of(std::span<const double> masses) {
  const double total = std::accumulate(masses.begin(), masses.end(), 0.0);
  std::vector<double> entries = {0.0};
  double sum = 0.0;
  for (const double mass : masses) {
    sum += mass;
    entries.push_back(total > 0.0 ? sum / total : 0.0);
  }
  return entries;
}

double between(double low, double high, double share) { return low + (high - low) * share; }

}  // namespace

RosenblattTransform::RosenblattTransform(SharedGrid<double> masses, MapMeasure positions)
    : masses_(std::move(masses)),
      measure_(positions),
      rows_(entries_of(row_marginal(masses_))),
      columns_(entries_of(column_marginal(masses_))),
      sums_({(masses_.extent().width + kStep - 1) / kStep, masses_.extent().height}) {
  const Extent extent = masses_.extent();
  for (int y = 0; y < extent.height; ++y) {
    double sum = 0.0;
    for (int x = 0; x < extent.width; ++x) {
      if (x % kStep == 0) sums_(x / kStep, y) = sum;
      sum += masses_(x, y);
    }
    row_masses_.push_back(sum);
  }
  for (int y = 0; y <= extent.height; ++y) {
    heights_.push_back(cos_theta(static_cast<double>(y) / extent.height));
  }
}

std::array<double, 2> RosenblattTransform::entries_around(int x, int y) const {
  const double total = row_masses_[static_cast<std::size_t>(y)];
  if (!(total > 0.0)) return {0.0, 0.0};
  double sum = sums_(x / kStep, y);
  for (int before = x - x % kStep; before < x; ++before) sum += masses_(before, y);
  return {sum / total, (sum + masses_(x, y)) / total};
}

RosenblattPoint RosenblattTransform::operator()(SquarePoint at, int x, int y) const {
  return (*this)(at, cos_theta(at.t), x, y);
}

RosenblattPoint RosenblattTransform::operator()(SquarePoint at, double cosine, int x, int y) const {
  const auto column = static_cast<std::size_t>(x);
  const auto row = static_cast<std::size_t>(y);
  const Extent extent = masses_.extent();
  const double share_of_cell = std::clamp(at.s * extent.width - x, 0.0, 1.0);
  const double low = heights_[row];
  const double share_of_row =
      measure_ == MapMeasure::square
          ? std::clamp(at.t * extent.height - y, 0.0, 1.0)
          : std::clamp((cosine - low) / (heights_[row + 1] - low), 0.0, 1.0);
  const auto [left, right] = entries_around(x, y);
  return {between(rows_[row], rows_[row + 1], share_of_row),
          between(left, right, share_of_cell),
          between(columns_[column], columns_[column + 1], share_of_cell),
          y,
          share_of_row,
          share_of_cell};
}

}  // namespace lightproof::reference
