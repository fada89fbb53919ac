#include "lightproof/samplers/cdf_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {

void quantise_cdf(std::span<const double> weights, std::span<std::uint32_t> knots) {
  std::vector<double> sums(weights.size());
  std::inclusive_scan(weights.begin(), weights.end(), sums.begin());
  const double total = sums.empty() ? 0.0 : sums.back();
  const auto positive =
      std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0; });
  const auto shared = static_cast<double>(kCdfOne - static_cast<std::uint32_t>(positive));
  std::uint32_t reserved = 0;
  knots[0] = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    if (weights[k] > 0) ++reserved;
    // sums[k] / total is exactly 1 from the last positive weight on, so the end is exact.
    knots[k + 1] =
        total > 0 ? reserved + static_cast<std::uint32_t>(shared * (sums[k] / total)) : 0;
  }
}

CdfTable::CdfTable(const EnvironmentMap& map, TargetDensity target)
    : extent_(map.radiance.extent()),
      weighting_(target.weighting),
      rows_(static_cast<std::size_t>(extent_.height) + 1),
      columns_((static_cast<std::size_t>(extent_.width) + 1) *
               static_cast<std::size_t>(extent_.height)) {
  const std::size_t stride = static_cast<std::size_t>(extent_.width) + 1;
  std::vector<double> row_weights(static_cast<std::size_t>(extent_.height));
  parallel_for(row_weights.size(), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    std::vector<double> weights(static_cast<std::size_t>(extent_.width));
    std::transform(map.radiance.row(y).begin(), map.radiance.row(y).end(), weights.begin(),
                   [&](Rgb rgb) { return luminance(rgb, target.grey); });
    quantise_cdf(weights, {columns_.data() + row * stride, stride});
    row_weights[row] = std::accumulate(weights.begin(), weights.end(), 0.0) *
                       (weighting_ == Weighting::B ? texel_solid_angle(extent_, y) : 1.0);
  });
  quantise_cdf(row_weights, rows_);
  if (rows_.back() == 0) {
    throw InputError(fmt::format("{}: the map is black: there is no light to sample", map.name));
  }
  for (int y = 0; y < extent_.height; ++y) {
    const double texels = weighting_ == Weighting::A ? static_cast<double>(extent_.count())
                                                     : 1.0 / texel_solid_angle(extent_, y);
    row_density_.push_back(0x1p-62 * units(rows_, y) * texels);
  }
}

}  // namespace lightproof
