// The distribution of a bilinear look-up, in double: every texel's luminance spreads as a tent over
// its neighbours in s (around the seam) and in t (all of it that would lie beyond a pole stays
// before it), and all integrals are those of products of two tents, each by Gauss-Legendre nodes.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/image/target_density.h"
#include "lightproof/image/texel_luminance.h"
#include "reference/rosenblatt_transform.h"

namespace lightproof::reference {

/// What the tent of one texel of a line adds to an integral along the line.
struct TentPart {
  int texel;        ///< index of the texel in its line
  double integral;  ///< ∫ of the tent, which is 1 at the texel's centre, times the weight
};

/// ∫ of tent times weight between two positions in [0,1], for all tents of a line of `texels` that
/// are not 0 there. `wraps`: the line is a circle; else the last tents are 1 beyond the last
/// centres. The weight is smooth; no piece is wider than 1/64.
std::vector<TentPart> tent_parts(double low, double high, int texels, bool wraps,
                                 const std::function<double(double)>& weight);

/// What a density interpolates between the centres of texels, given their luminances: these
/// themselves, or, of a density that weighs texels, these times the solid angle of their texel, up
/// to a constant factor.
Grid<double> interpolated_by(DensitySpace density_space, Grid<double> luminance);

/// interpolated_by() of a map's texels, each computed when it is asked for.
class InterpolatedTexels {
 public:
  /// The map outlives this.
  InterpolatedTexels(const EnvironmentMap& map, TargetDensity target);

  Extent extent() const { return luminance_.extent(); }
  double operator()(int x, int y) const {
    const double luminance = luminance_(x, y);
    return factors_.empty() ? luminance : luminance * factors_[static_cast<std::size_t>(y)];
  }

 private:
  TexelLuminance luminance_;
  std::vector<double> factors_;  ///< of the rows; empty: 1
};

/// Probability of every cell of a `cells` grid laid over the square; they sum to 1. Throws
/// InputError if the map is black.
Grid<double> bilinear_masses(const EnvironmentMap& map, TargetDensity target, Extent cells);

/// The Rosenblatt transform of the density over the square that is proportional to what is
/// interpolated bilinearly, see interpolated_by(), under B times sin(pi t). Of the sums along rows
/// it keeps every eighth, and adds up the others from there when they are asked for.
class BilinearTransform {
 public:
  /// Integrates the map once; it must not be black, and outlives this.
  BilinearTransform(const EnvironmentMap& map, TargetDensity target);
  BilinearTransform(EnvironmentMap&& map, TargetDensity target) = delete;

  /// The transformed coordinates of a position; its row is one of patches, of which there are
  /// H + 1 between the centres of texels and beyond the outermost of them.
  RosenblattPoint operator()(SquarePoint at) const;

  /// Probability of every row of patches, H + 1 of them from t = 0 up; they sum to 1.
  std::vector<double> rows() const;

  /// ∫ of what is interpolated over the square, under B times sin(pi t).
  double total() const { return total_; }

 private:
  /// Patches of a row from one sum that is kept to the next.
  static constexpr int kStep = 8;

  /// ∫ of the interpolation around a row of texels from 0 to s, and to the edges of the patch in
  /// which s lies.
  struct SumsAt {
    double patch_left;
    double below;
    double patch_right;
  };
  SumsAt sums_at(int y, double s) const;
  /// ∫ of the marginal over t between two positions of one row of patches.
  double marginal_mass(double low, double high) const;

  Extent extent_;
  MapMeasure measure_;  ///< in which the density is that of the interpolation
  InterpolatedTexels luminance_;
  std::vector<double> row_means_;
  std::vector<double> marginal_;     ///< mass below the lower edge of every row of patches, and 1
  std::vector<double> columns_;      ///< luminance of the columns, weighted as their rows are
  std::vector<double> column_sums_;  ///< up to each edge of the patches across: W + 2
  Grid<double> sums_;                ///< up to every kStep-th edge, for every row of texels
  double total_ = 0.0;
};

}  // namespace lightproof::reference
