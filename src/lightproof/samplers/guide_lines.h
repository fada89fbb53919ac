// Inversion in three steps at about 2.3 bytes a texel: guide tables find the row and the run of 32
// texels in it, and the run's 16-bit CDF entries are compared with what is left of the random
// number. Monotone: it keeps stratification. Of the larger table it reads one line of the cache a
// sample, and three in runs of much contrast.
#pragma once

#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/cdf_lines.h"
#include "lightproof/samplers/guide_table.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/samplers/texel_positions.h"

namespace lightproof {

/// The sampler by guide tables over rows and runs and a search inside the run.
class GuideLines {
 public:
  /// Throws InputError if the map is black.
  GuideLines(const EnvironmentMap& map, TargetDensity target);

  TexelDraw draw(SquarePoint u) const { return finish(run_of(u)); }
  TexelSample sample(SquarePoint u) const { return positions_.sample(draw(u)); }

  /// A run of texels, and what is left of the two random numbers.
  struct Run {
    int row;
    int index;               ///< of the run in its row
    double column_fraction;  ///< share of the run's mass before the texel and the position in it
    double row_fraction;     ///< share of the row's mass
    double mass;             ///< the run's probability
  };
  /// Begins the sample draw(u): asks the memory for what finish() reads.
  /// The guide tables and sums of rows and runs are read for that: they are small beside the
  /// texels. Other work, or the beginnings of other samples, may lie between the two.
  Run prepare(SquarePoint u) const {
    const Run run = run_of(u);
    lines_.prefetch(lines_.index(run.index, run.row));
    return run;
  }
  /// The sample that prepare() began.
  TexelDraw finish(const Run& run) const {
    const RunTexel found = lines_.find(lines_.index(run.index, run.row), run.column_fraction);
    return {run.index * kRunTexels + found.index, run.row, found.fraction, run.row_fraction,
            run.mass * found.mass};
  }
  const TexelPositions& positions() const { return positions_; }

  PerSquare pdf(SquarePoint at) const {
    const int y = cell_of(at.t, positions_.extent().height);
    const int x = cell_of(at.s, positions_.extent().width);
    const double share = lines_.mass(lines_.index(x / kRunTexels, y), x % kRunTexels);
    return positions_.pdf(y, table_.mass(x / kRunTexels, y) * share, at);
  }

  struct View {
    CdfTable::View runs;
    GuidedEntries::View guides;
    CdfLines::View lines;
    TexelPositionsView positions;
  };
  View view() const { return {table_.view(), guides_.view(), lines_.view(), positions_.view()}; }

  std::size_t table_bytes() const {
    return lines_.bytes() + table_.bytes() + guides_.bytes() + positions_.bytes();
  }

 private:
  GuideLines(const Grid<double>& weights, DensitySpace density_space, const Mapping& mapping);

  Run run_of(SquarePoint u) const {
    const double scaled_t = below_one(u.t) * kCdfOne;
    const double scaled_s = below_one(u.s) * kCdfOne;
    const CdfCell row = guides_.row(table_, static_cast<std::uint32_t>(scaled_t));
    const CdfCell run = guides_.column(table_, row.index, static_cast<std::uint32_t>(scaled_s));
    return {row.index, run.index, run.fraction(scaled_s), row.fraction(scaled_t),
            cdf_mass(row.units(), run.units())};
  }

  CdfLines lines_;
  CdfTable table_;  ///< distribution of the runs
  GuidedEntries guides_;
  TexelPositions positions_;
};
static_assert(EnvSampler<GuideLines>);

/// Draws a batch by vectors, as many whole ones as fit, from the front. Returns how many samples
/// these are.
std::size_t sample_vectors(const GuideLines::View& table, const BatchPoints& points,
                           const BatchOutput& output);

}  // namespace lightproof
