#include "lightproof/gate/row_bands.h"

#include <algorithm>
#include <numeric>

namespace lightproof {
namespace {

constexpr int kBandsBetween = 3;

}  // namespace

std::vector<RowBand> row_bands(std::span<const double> row_masses) {
  const int rows = static_cast<int>(row_masses.size());
  std::vector<int> starts = {0};
  const int between = std::min(kBandsBetween, rows - 2);
  for (int i = 0; i < between; ++i) starts.push_back(1 + i * (rows - 2) / between);
  if (rows > 1) starts.push_back(rows - 1);
  starts.push_back(rows);
  std::vector<RowBand> bands;
  double below = 0.0;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
    const auto masses = row_masses.subspan(static_cast<std::size_t>(starts[i]),
                                           static_cast<std::size_t>(starts[i + 1] - starts[i]));
    const double mass = std::accumulate(masses.begin(), masses.end(), 0.0);
    bands.push_back({starts[i], starts[i + 1] - 1, below, mass});
    below += mass;
  }
  return bands;
}

}  // namespace lightproof
