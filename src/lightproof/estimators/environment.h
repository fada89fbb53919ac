// Directions drawn from the map by a table: in proportion to its luminance, or to what is left of
// it when a share of its mean is taken off (MIS compensation, Karlík et al. 2019, "MIS
// Compensation: Optimizing Sampling Techniques in Multiple Importance Sampling").
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lightproof/estimators/light_samples.h"
#include "lightproof/samplers/guide_table.h"

namespace lightproof {

/// A table of the luminance above a share of its mean, max(0, L - compensation · mean), by the
/// fastest monotone sampler. Where hardly anything is left of the light (below 1e-6 of it, as of a
/// constant map), nothing is taken off.
class EnvironmentTable {
 public:
  /// The compensation is in [0,1]. The map must outlive this. A black map is allowed.
  EnvironmentTable(const EnvironmentMap& map, DensitySpace density_space, double compensation);

  /// Whether there is light to draw from; of a black map there is none.
  bool has_light() const { return table_.has_value(); }
  /// Draws directions, their densities and texels; there must be light. k is left out.
  void draw(const BatchPoints& points, LightSamples& samples) const {
    draw_batch(*table_, points, samples.batch());
  }
  /// The density of the direction with this distance from the axis in a texel of a row, per
  /// steradian, but for what the table rounds.
  double pdf(Rgb texel, int row, double sine) const {
    const double left = luminance_of(texel, weights_) - floor_;
    if (!(left > 0.0)) return 0.0;
    const double density = left * scales_[static_cast<std::size_t>(row)];
    return positions_ == MapMeasure::square ? density / sine : density;
  }
  std::size_t bytes() const {
    return table_ ? table_->table_bytes() + scales_.size() * sizeof(double) : 0;
  }

 private:
  MapMeasure positions_;
  LuminanceWeights weights_;
  double floor_ = 0.0;  ///< luminance that is taken off
  /// For each row the density over the luminance, times the sine if positions are uniform in the
  /// square.
  std::vector<double> scales_;
  std::optional<GuideTable> table_;
};

/// The map by this density, by the fastest monotone table. Throws InputError if the map is black.
PreparedSource environment_source(const EnvironmentMap& map, DensitySpace density_space);

/// The map by this density, by one alias table over all texels, which is not monotone: neighbouring
/// points go to unrelated texels. Throws InputError if the map is black.
PreparedSource alias_source(const EnvironmentMap& map, DensitySpace density_space);

}  // namespace lightproof
