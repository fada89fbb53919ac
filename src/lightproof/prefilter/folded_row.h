// Rows of a folded map: the light of opposite directions added up, so that one hemisphere is left.
//
// With H the upper hemisphere, V the map's vector ∫ L w d(omega) and V' the part of V from below,
//
//   E(n) = ∫ over H of (L(w) + L(-w)) (n·w)+ d(omega) + n·V'   for normals n in H,
//   E(-n) = E(n) - n·V,
//
// since (-x)+ = (x)+ - x. Half of the rows and half of the normals are a quarter of the work.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// ∫ L w d(omega) of red, green and blue, by components: along the longitude s = 0 of the map,
/// along s = 1/4, and along z.
struct LightVector {
  glm::dvec3 cosine = glm::dvec3(0.0);
  glm::dvec3 sine = glm::dvec3(0.0);
  glm::dvec3 height = glm::dvec3(0.0);

  LightVector& operator+=(const LightVector& other) {
    cosine += other.cosine;
    sine += other.sine;
    height += other.height;
    return *this;
  }
};

/// Columns and rows of the folded map, and the edges of both.
struct FoldedLattice {
  explicit FoldedLattice(Extent map);

  int rows() const { return static_cast<int>(parallels.size()) - 1; }

  /// As many as the map's, or twice as many if that is odd: opposite columns must be columns.
  int columns;
  /// theta of the edges of the rows, from the zenith to the horizon; if the map's rows are odd, the
  /// last row of the folded one is half as high.
  std::vector<double> parallels;
  /// ∫ cos(2 pi s) and ∫ sin(2 pi s) over each column, in radians of longitude.
  std::vector<double> cosine;
  std::vector<double> sine;
};

/// One row, as combs of columns c, c + columns/teeth, c + 2 columns/teeth, … all around, for c from
/// 0 to below `columns`. A comb is 3 `teeth` numbers, red, green and blue of each tooth.
class FoldedRow {
 public:
  /// The number of teeth divides that of columns.
  FoldedRow(const FoldedLattice& lattice, int teeth);

  /// Takes row `k`, counted from the zenith.
  void fold(const EnvironmentMap& map, int k);

  /// L(w) + L(-w) in each column of the comb.
  std::span<const double> light(int column) const { return comb(light_, column); }
  /// The components of ∫ (L(w) + L(-w)) w d(omega) over the columns from 0 to before each column of
  /// the comb; those past the seam have the whole row's added.
  std::span<const double> cosine_before(int column) const { return comb(cosine_, column); }
  std::span<const double> sine_before(int column) const { return comb(sine_, column); }
  std::span<const double> height_before(int column) const { return comb(height_, column); }

  /// The whole row's.
  const LightVector& folded_sum() const { return folded_sum_; }
  /// What of the map's own vector comes from the lower hemisphere, through this row.
  const LightVector& lower_sum() const { return lower_sum_; }

 private:
  std::size_t place(int column) const {
    return static_cast<std::size_t>(column % stride_) * 2 * comb_ +
           static_cast<std::size_t>(column / stride_) * 3;
  }
  std::span<const double> comb(const std::vector<double>& values, int column) const {
    return std::span(values).subspan(place(column), comb_);
  }
  void put(std::vector<double>& values, int column, glm::dvec3 rgb) const;
  void append_second_turn();

  const FoldedLattice& lattice_;
  int stride_;
  std::size_t comb_;  ///< numbers of a comb
  // Two turns, so that every comb is a run of memory: by the column's remainder by the stride, then
  // by its quotient, then by channel.
  std::vector<double> light_;
  std::vector<double> cosine_;
  std::vector<double> sine_;
  std::vector<double> height_;
  LightVector folded_sum_;
  LightVector lower_sum_;
};

}  // namespace lightproof
