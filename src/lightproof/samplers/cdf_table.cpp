#include "lightproof/samplers/cdf_table.h"

#include <algorithm>
#include <numeric>

#include "lightproof/core/parallel.h"
#include "lightproof/samplers/texel_weights.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {

void quantise_cdf(std::span<const double> weights, std::span<std::uint32_t> knots,
                  std::uint32_t one) {
  std::vector<double> sums(weights.size());
  std::inclusive_scan(weights.begin(), weights.end(), sums.begin());
  const double total = sums.empty() ? 0.0 : sums.back();
  const auto positive =
      std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0; });
  const auto shared = static_cast<double>(one - static_cast<std::uint32_t>(positive));
  std::uint32_t reserved = 0;
  knots[0] = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    if (weights[k] > 0) ++reserved;
    // sums[k] / total is exactly 1 from the last positive weight on, so the end is exact.
    knots[k + 1] =
        total > 0 ? reserved + static_cast<std::uint32_t>(shared * (sums[k] / total)) : 0;
  }
}

/// weigh(y, weights) writes the weights of a row.
template <class Weigh>
void CdfTable::fill(const Weigh& weigh) {
  const std::size_t stride = static_cast<std::size_t>(extent_.width) + 1;
  rows_.resize(static_cast<std::size_t>(extent_.height) + 1);
  columns_.resize(stride * static_cast<std::size_t>(extent_.height));
  std::vector<double> row_weights(static_cast<std::size_t>(extent_.height));
  parallel_for(row_weights.size(), [&](std::size_t row) {
    std::vector<double> weights(static_cast<std::size_t>(extent_.width));
    weigh(static_cast<int>(row), weights);
    quantise_cdf(weights, {columns_.data() + row * stride, stride});
    row_weights[row] = std::accumulate(weights.begin(), weights.end(), 0.0);
  });
  quantise_cdf(row_weights, rows_);
}

CdfTable::CdfTable(const EnvironmentMap& map, TargetDensity target)
    : extent_(map.radiance.extent()) {
  fill([&](int y, std::span<double> weights) {
    const double area = target.weighting == Weighting::B ? texel_solid_angle(extent_, y) : 1.0;
    const auto texels = map.radiance.row(y);
    std::transform(texels.begin(), texels.end(), weights.begin(),
                   [&](Rgb rgb) { return area * luminance(rgb, target.grey); });
  });
  if (rows_.back() == 0) refuse_black(map);
}

CdfTable::CdfTable(const Grid<double>& weights) : extent_(weights.extent()) {
  fill([&](int y, std::span<double> row) { std::ranges::copy(weights.row(y), row.begin()); });
}

}  // namespace lightproof
