// What most renderers do, as plainly as it can be written: a float CDF of the rows, one of the
// columns in each row, and std::upper_bound. Every ratio of speed refers to it.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof::bench {

class UpperBoundBaseline {
 public:
  /// A table of the luminances, times the texels' solid angles as the density says.
  explicit UpperBoundBaseline(const EnvironmentMap& map,
                              DensitySpace density_space = DensitySpace::texture)
      : extent_(map.radiance.extent()), density_space_(density_space) {
    std::vector<double> row_weights;
    for (int y = 0; y < extent_.height; ++y) {
      std::vector<double> weights;
      const double solid_angle =
          texel_measure(density_space) == MapMeasure::square ? 1.0 : texel_solid_angle(extent_, y);
      for (const Rgb rgb : map.radiance.row(y)) {
        weights.push_back(luminance_of(rgb, kRec709) * solid_angle);
      }
      row_weights.push_back(append_cdf(columns_, weights));
    }
    append_cdf(rows_, row_weights);
    for (int y = 0; y <= extent_.height; ++y) {
      heights_.push_back(-std::cos(kPi * y / extent_.height));
    }
  }

  /// The direction of a sample by the library's sine and cosine, with its density per steradian.
  LightSample direction(SquarePoint u) const {
    const Found row = find(rows_, u.t);
    const Found column = find(columns_of(row.index), u.s);
    const double phi = kPi - 2.0 * kPi * (column.index + column.fraction) / extent_.width;
    const double mass = row.mass * column.mass;
    const auto y = static_cast<std::size_t>(row.index);
    double sine;
    double z;
    double pdf;
    if (position_measure(density_space_) == MapMeasure::solid_angle) {
      const double span = heights_[y + 1] - heights_[y];
      z = heights_[y] + row.fraction * span;
      sine = std::sqrt(std::max(0.0, 1.0 - z * z));
      pdf = mass * extent_.width / (2.0 * kPi * span);
    } else {
      const double theta = kPi * (row.index + row.fraction) / extent_.height;
      sine = std::sin(theta);
      z = -std::cos(theta);
      pdf = mass * static_cast<double>(extent_.count()) / (2.0 * kPi * kPi * sine);
    }
    return {{sine * std::cos(phi), sine * std::sin(phi), z}, {pdf}, column.index, row.index};
  }

  TexelSample sample(SquarePoint u) const {
    const Found row = find(rows_, u.t);
    const Found column = find(columns_of(row.index), u.s);
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

  std::span<const float> columns_of(int y) const {
    const auto stride = static_cast<std::size_t>(extent_.width) + 1;
    return std::span(columns_).subspan(static_cast<std::size_t>(y) * stride, stride);
  }

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
  DensitySpace density_space_;
  std::vector<float> rows_;
  std::vector<float> columns_;
  std::vector<double> heights_;  ///< z at the edges of rows
};

}  // namespace lightproof::bench
