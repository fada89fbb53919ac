// The sampler of the lecture "Image-based Lighting", as published: float sums over precomputed row
// averages, then over the luminances of the row, stopping where the sum *reaches* the random
// number. Its edge behaviour is kept: the first row or column is chosen at u = 0 even without mass
// (0/0), a sum that rounds below the random number runs off the end, a fetch outside reads black.
// The only liberty: our maps are linear, so its decoding of 8-bit texels (^2.2) has been done.
#pragma once

#include <vector>

#include "lightproof/samplers/texel_positions.h"

namespace lightproof {

/// The lecture's sampler as it is published, defects and all.
class LinearScanPublished {
 public:
  /// Refers to the map, which must outlive the sampler. Throws InputError if the map is black.
  LinearScanPublished(const EnvironmentMap& map, TargetDensity target);
  /// The sampler as listed: without that refusal. On a black map, or one of whose texels is not a
  /// number, no sum ever reaches a random number.
  static LinearScanPublished as_listed(const EnvironmentMap& map, TargetDensity target) {
    return {map, target, AsListed{}};
  }

  TexelSample sample(SquarePoint u) const;
  PerSquare pdf(SquarePoint at) const;
  /// Bytes of the table, which is the map itself (12 bytes a texel) and the averages of rows.
  std::size_t table_bytes() const;
  const Mapping& mapping() const { return map_->mapping; }

 private:
  struct AsListed {};
  LinearScanPublished(const EnvironmentMap& map, TargetDensity target, AsListed);

  float weight(int x, int y) const;
  float average_of(int y) const;
  PerSquare pdf_in(int x, int y, SquarePoint at) const;

  const EnvironmentMap* map_;
  MapMeasure position_measure_;
  SolidAngleRows solid_angle_rows_;
  glm::vec3 weights_;
  /// 1 under A; the texel's solid angle under B and C, where a row shares it.
  std::vector<float> row_factor_;
  bool weighs_each_texel_;          ///< by a solid angle of its own
  std::vector<float> row_average_;  ///< mean of the weights of each row
  float total_average_ = 0.0F;
};

}  // namespace lightproof
