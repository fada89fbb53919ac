// What most renderers do, as plainly as it can be written: a float CDF of the rows, one of the
// columns in each row, and std::upper_bound. Every ratio of speed refers to it.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/samplers/sampler.h"

namespace lightproof::bench {

class UpperBoundBaseline {
 public:
  /// A table of the luminances, as a density over (s,t).
  explicit UpperBoundBaseline(const EnvironmentMap& map) : extent_(map.radiance.extent()) {
    std::vector<double> row_weights;
    for (int y = 0; y < extent_.height; ++y) {
      std::vector<double> weights;
      for (const Rgb rgb : map.radiance.row(y)) weights.push_back(luminance_of(rgb, kRec709));
      row_weights.push_back(append_cdf(columns_, weights));
    }
    append_cdf(rows_, row_weights);
  }

  TexelSample sample(SquarePoint u) const {
    const Found row = find(rows_, u.t);
    const auto stride = static_cast<std::size_t>(extent_.width) + 1;
    const Found column = find(
        std::span(columns_).subspan(static_cast<std::size_t>(row.index) * stride, stride), u.s);
    const double texels = static_cast<double>(extent_.count());
    return {{(column.index + column.fraction) / extent_.width,
             (row.index + row.fraction) / extent_.height},
            column.index,
            row.index,
            {row.mass * column.mass * texels}};
  }

  PerSquare pdf(SquarePoint at) const {
    const auto x = static_cast<std::size_t>(cell_of(at.s, extent_.width));
    const auto y = static_cast<std::size_t>(cell_of(at.t, extent_.height));
    const std::size_t column = y * (static_cast<std::size_t>(extent_.width) + 1) + x;
    const auto row_mass = static_cast<double>(rows_[y + 1] - rows_[y]);
    const auto column_mass = static_cast<double>(columns_[column + 1] - columns_[column]);
    return {row_mass * column_mass * static_cast<double>(extent_.count())};
  }

  std::size_t table_bytes() const { return (rows_.size() + columns_.size()) * sizeof(float); }

 private:
  struct Found {
    int index;
    double mass;
    double fraction;
  };

  static Found find(std::span<const float> cdf, double u) {
    const auto above = std::upper_bound(cdf.begin() + 1, cdf.end() - 1, static_cast<float>(u));
    const double low = static_cast<double>(above[-1]);
    const double mass = static_cast<double>(*above) - low;
    return {static_cast<int>(above - cdf.begin()) - 1, mass,
            std::clamp((u - low) / mass, 0.0, 1.0)};
  }

  /// Returns the sum of the weights.
  static double append_cdf(std::vector<float>& cdf, std::span<const double> weights) {
    double total = 0.0;
    for (const double weight : weights) total += weight;
    double sum = 0.0;
    cdf.push_back(0.0F);
    for (const double weight : weights) {
      cdf.push_back(static_cast<float>((sum += weight) / total));
    }
    return total;
  }

  Extent extent_;
  std::vector<float> rows_;
  std::vector<float> columns_;
};

}  // namespace lightproof::bench
