// The luminance of texels, without memory of its own where a map has the colours.
#pragma once

#include <utility>

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// The luminance of every texel: that of a map's colours, weighed whenever it is asked for (of a
/// large map a grid of it would be two thirds of the map's own memory), or stored values.
class TexelLuminance {
 public:
  TexelLuminance() = default;
  explicit(false) TexelLuminance(Grid<double> values)
      : extent_(values.extent()), values_(std::move(values)) {}
  /// The map outlives this.
  TexelLuminance(const EnvironmentMap& map, LuminanceWeights weights)
      : extent_(map.radiance.extent()), radiance_(&map.radiance), weights_(weights) {}
  TexelLuminance(EnvironmentMap&& map, LuminanceWeights weights) = delete;

  Extent extent() const { return extent_; }
  double operator()(int x, int y) const {
    return radiance_ != nullptr ? luminance_of((*radiance_)(x, y), weights_) : values_(x, y);
  }

 private:
  Extent extent_;
  const Grid<Rgb>* radiance_ = nullptr;
  LuminanceWeights weights_ = kRec709;
  SharedGrid<double> values_;
};

}  // namespace lightproof
