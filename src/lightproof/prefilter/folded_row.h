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
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// Red, green and blue; the fourth is 0, for the sake of vector instructions.
using PaddedRgb = glm::dvec4;

/// ∫ L w d(omega) of red, green and blue, by components: along the longitude s = 0 of the map,
/// along s = 1/4, and along z.
struct LightVector {
  PaddedRgb cosine = PaddedRgb(0.0);
  PaddedRgb sine = PaddedRgb(0.0);
  PaddedRgb height = PaddedRgb(0.0);

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

/// One row of the folded map.
class FoldedRow {
 public:
  explicit FoldedRow(const FoldedLattice& lattice);

  /// Takes row `k`, counted from the zenith.
  void fold(const EnvironmentMap& map, int k);

  int columns() const { return lattice_.columns; }
  /// L(w) + L(-w), of each column, and once more from the seam on: runs may go beyond it.
  std::span<const PaddedRgb> light() const { return light_; }
  /// Sums over the columns before each edge, from none to all of them: of L(w) + L(-w) times
  /// ∫ cos(2 pi s), times ∫ sin(2 pi s), and alone. With the row's factors they are the components
  /// of ∫ (L(w) + L(-w)) w d(omega).
  std::span<const LightVector> before() const { return before_; }
  double level_factor() const { return level_; }
  double height_factor() const { return height_; }

  /// ∫ (L(w) + L(-w)) w d(omega).
  LightVector folded() const { return scaled(before_.back()); }
  /// What of the map's own vector comes from the lower hemisphere, through this row.
  LightVector lower() const { return lower_; }

 private:
  LightVector scaled(const LightVector& sums) const {
    return {level_ * sums.cosine, level_ * sums.sine, height_ * sums.height};
  }

  const FoldedLattice& lattice_;
  double level_ = 0.0;
  double height_ = 0.0;
  std::vector<PaddedRgb> light_;
  std::vector<LightVector> before_;
  LightVector lower_;
};

}  // namespace lightproof
