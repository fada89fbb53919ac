// Normals of one tilt at equal steps of longitude, and what of the folded map they see: relative to
// such normals the columns lie alike, so that one set of weights serves them all.
#pragma once

#include <vector>

#include "lightproof/prefilter/cosine_band.h"
#include "lightproof/prefilter/folded_row.h"

namespace lightproof {

/// Normals of the upper hemisphere, `teeth` of them, all around.
struct NormalComb {
  NormalTilt tilt;
  double first;  ///< longitude 2 pi s of the first one, by any whole turns
  int teeth;     ///< a divisor of the folded map's columns
};

/// Columns [begin, end) relative to the first normal of the comb; they may go beyond the seam.
struct ColumnRun {
  int begin;
  int end;
};

/// What the first normal of a comb sees of a row: all, none or, in the texels that its horizon
/// crosses, a part.
struct RowView {
  ColumnRun seen;
  ColumnRun leaving;    ///< crossed by the horizon, after `seen`
  ColumnRun returning;  ///< crossed again, beyond the hidden ones and before `seen`
};

/// One comb's tables over the edges of a folded map's rows and columns.
class NormalCombView {
 public:
  NormalCombView(const NormalComb& comb, const FoldedLattice& lattice);

  const NormalComb& comb() const { return comb_; }
  /// How many rows, from the zenith, lie wholly above the horizon.
  int rows_seen() const { return rows_seen_; }
  CosineBand band(int row) const;
  RowView view(const CosineBand& band) const;
  /// ∫ (n·w)+ d(omega), in steradian, over the texel of this band and column, which must be one of
  /// leaving or returning.
  double weight(const CosineBand& band, int column) const {
    return band(edge(column + 1)) - band(edge(column));
  }

 private:
  /// Of the columns from a quarter turn before to a quarter turn after the one opposite the normal:
  /// nearer ones, in the upper hemisphere, are always seen.
  const Meridian& edge(int column) const {
    return edges_[static_cast<std::size_t>(column - first_edge_)];
  }
  /// The last edge at or before this azimuth.
  int edge_before(double azimuth) const;

  NormalComb comb_;
  int columns_;
  int first_edge_;
  std::vector<Meridian> edges_;
  std::vector<Parallel> parallels_;
  int rows_seen_ = 0;
};

}  // namespace lightproof
