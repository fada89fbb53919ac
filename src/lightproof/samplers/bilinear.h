// Inversion of the bilinear look-up itself: density zero only where the look-up is, so a renderer
// that interpolates loses no light beside a texel in black.
//
// Between the centres of four texels the look-up is one bilinear patch. The table holds the exact
// integral of every patch; a point chooses the row of patches, then the patch, by guide tables. In
// the patch the marginal over t is inverted (linear under A and C; linear times sin(pi t) under B,
// by Newton's method), then the conditional over s, which is linear. Patches end at the seam and at
// the poles, so that the map is monotone: it keeps stratification. A piecewise-constant
// table dilated until it covers the look-up needs none of this, but draws another density, which
// adds variance wherever texels differ.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "lightproof/samplers/guide_table.h"
#include "lightproof/samplers/linear_density.h"
#include "lightproof/samplers/sampler.h"

namespace lightproof {

/// The patches of a map of W x H texels: W + 1 across, since the one on the seam is cut in two, and
/// H + 1 along, with half rows at the poles that are constant in t.
class BilinearPatches {
 public:
  /// Keeps the map's luminances, under C times sin(theta) of their row, as floats; those that a
  /// float cannot tell from 0 are 0. Throws InputError if all are.
  BilinearPatches(const EnvironmentMap& map, TargetDensity target);

  /// How many patches there are across and along.
  Extent extent() const { return {texels().width + 1, texels().height + 1}; }
  /// Extent of the map in texels.
  Extent texels() const { return luminance_.extent(); }
  /// ∫ of what is interpolated over each patch: over the square under A and C, in steradian under
  /// B.
  Grid<double> weights() const;
  /// The sample in patch (column, row), which is drawn with probability `mass`, at the point below
  /// whose t lies the share `row_fraction` of the patch's mass, and to the left of which lies the
  /// share `column_fraction` of the mass at that t.
  TexelSample sample(int column, int row, double column_fraction, double row_fraction,
                     double mass) const;
  /// The column of patches that this s lies in.
  int column_of(double s) const;
  /// The row of patches that this t lies in.
  int row_of(double t) const;
  /// Density over the square at `at`, in this patch of probability `mass`.
  PerSquare pdf(int column, int row, double mass, SquarePoint at) const {
    return density(corners(column, row), column, row, mass, at);
  }
  std::size_t bytes() const {
    return luminance_.values().size() * sizeof(float) + rows_.size() * sizeof(Row);
  }

 private:
  /// The part of the way from one centre to the next that a patch covers.
  struct Part {
    double begin = 0.0;
    double length = 1.0;
  };
  static Part part(int index, int count) {
    return {index == 0 ? 0.5 : 0.0, index == 0 || index == count ? 0.5 : 1.0};
  }
  /// The share of a covered part that lies before a position on the way from one centre to the
  /// next.
  static double share_of_part(double way, Part covered) {
    return std::clamp((way - covered.begin) / covered.length, 0.0, 1.0);
  }
  /// ∫ of the weight of a position over the t of a row: of what falls from 1 to 0, and of what
  /// rises from 0 to 1.
  struct Row {
    double falling;
    double rising;
  };
  /// What is interpolated, at the corners of a patch: low and high in s, in t.
  struct Corners {
    double luminance[2][2];  ///< [t][s]
    double low() const { return 0.5 * (luminance[0][0] + luminance[0][1]); }
    double high() const { return 0.5 * (luminance[1][0] + luminance[1][1]); }
  };

  Row weigh(int row) const;
  /// The sine along a row, from its edge at the nearer pole.
  LinearTimesSine from_pole(int row) const;
  /// Whether a row is mirrored, as the inverse would lose precision there.
  bool is_upper(int row) const { return 2 * row > texels().height; }
  Corners corners(int column, int row) const;
  double integral(const Corners& corners, int column, int row) const {
    const Row& weight = rows_[static_cast<std::size_t>(row)];
    return part(column, texels().width).length / texels().width *
           (corners.low() * weight.falling + corners.high() * weight.rising);
  }
  /// What is returned with a sample and what is asked for later are the same bits.
  PerSquare density(const Corners& corners, int column, int row, double mass, SquarePoint at) const;
  double position_in_row(const Corners& corners, int row, double share) const;

  MapMeasure measure_;     ///< in which the density is that of the interpolation
  Grid<float> luminance_;  ///< under C times sin(theta) at the row's centre
  std::vector<Row> rows_;
};

/// The sampler whose density is the bilinear look-up.
class Bilinear {
 public:
  /// Draws the bilinear look-up. Throws InputError if the map is black.
  Bilinear(const EnvironmentMap& map, TargetDensity target)
      : patches_(map, target), table_(patches_.weights()), guides_(table_) {}

  TexelSample sample(SquarePoint u) const {
    const double scaled_t = below_one(u.t) * kCdfOne;
    const double scaled_s = below_one(u.s) * kCdfOne;
    const CdfCell row = guides_.row(table_, static_cast<std::uint32_t>(scaled_t));
    const CdfCell column = guides_.column(table_, row.index, static_cast<std::uint32_t>(scaled_s));
    return patches_.sample(column.index, row.index, column.fraction(scaled_s),
                           row.fraction(scaled_t), cdf_mass(row.units(), column.units()));
  }

  PerSquare pdf(SquarePoint at) const {
    const int column = patches_.column_of(at.s);
    const int row = patches_.row_of(at.t);
    const double mass = table_.mass(column, row);
    return mass > 0.0 ? patches_.pdf(column, row, mass, at) : PerSquare{0.0};
  }

  const CdfTable& table() const { return table_; }
  /// The mapping of Lightproof's own frame: it is declared on no other map.
  Mapping mapping() const { return {}; }
  std::size_t table_bytes() const { return patches_.bytes() + table_.bytes() + guides_.bytes(); }

 private:
  BilinearPatches patches_;
  CdfTable table_;
  GuidedEntries guides_;
};
static_assert(EnvSampler<Bilinear>);

}  // namespace lightproof
