// The sampler of the lecture "Image-based Lighting", as published: float sums over precomputed row
// averages, then over the luminances of the row, stopping where the sum *reaches* the random
// number. Its edge behaviour is kept: the first row or column is chosen at u = 0 even without mass
// (0/0), a sum that rounds below the random number runs off the end, a fetch outside reads black.
// The only liberty: our maps are linear, so its decoding of 8-bit texels (^2.2) has been done.
#pragma once

#include <memory>
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
  Extent extent() const { return map_->radiance.extent(); }

  /// Where a scan stopped, and how far between the sums around that entry; the index is the number
  /// of entries if it ran off the end.
  struct Stop {
    int index;
    float fraction;
  };

 private:
  friend class CachedScan;
  struct AsListed {};
  LinearScanPublished(const EnvironmentMap& map, TargetDensity target, AsListed);

  TexelSample sample_at(Stop row, Stop column) const;
  /// What the scans sum, before they divide it by the number of entries. A row beyond the map is
  /// black.
  float row_probability(int y) const;
  float column_probability(int x, int y) const;
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

/// The published sampler where very many samples are drawn of one map, as tests do. The running
/// sums of a row do not depend on the random number: they are kept from the first sample that needs
/// them on, 4 bytes of each texel in the end, and searched by bisection. A sample is that of
/// LinearScanPublished::sample(), bit for bit. The map must outlive it.
class CachedScan {
 public:
  explicit CachedScan(LinearScanPublished scan);
  CachedScan(CachedScan&& other) noexcept;
  ~CachedScan();

  /// Many threads may call it.
  TexelSample sample(SquarePoint u) const;
  PerSquare pdf(SquarePoint at) const { return scan_.pdf(at); }
  /// Bytes of the published sampler's table, without the sums.
  std::size_t table_bytes() const { return scan_.table_bytes(); }

 private:
  struct Sums;

  LinearScanPublished scan_;
  std::unique_ptr<Sums> sums_;
};

}  // namespace lightproof
