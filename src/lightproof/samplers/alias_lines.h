// Two levels at 2.5 bytes a texel: the alias method chooses among runs of 32 texels, whose 16-bit
// CDF entries are then compared with what is left of the random number. One line of the cache a
// sample of the larger table, and three in runs of much contrast; not monotone, so it loses
// stratification.
#pragma once

#include "lightproof/samplers/alias_table.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/cdf_lines.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/samplers/texel_positions.h"

namespace lightproof {

/// The sampler by an alias table over runs of texels and a search inside the run.
class AliasLines {
 public:
  /// Throws InputError if the map is black.
  AliasLines(const EnvironmentMap& map, TargetDensity target);

  /// The texel at a point: u.s names the column of the alias table and the position over t in the
  /// texel, u.t chooses between the column's two runs, and the texel in the run with the position
  /// over s.
  TexelDraw draw(SquarePoint u) const { return finish(table_.draw(u.s, u.t)); }
  TexelSample sample(SquarePoint u) const { return positions_.sample(draw(u)); }
  /// Begins the sample draw(u): asks the memory for what finish() reads.
  /// The alias table is read for that: it is small beside the texels. Other work, or the
  /// beginnings of other samples, may lie between the two.
  AliasTable::Drawn prepare(SquarePoint u) const {
    const AliasTable::Drawn drawn = table_.draw(u.s, u.t);
    lines_.prefetch(drawn.cell);
    return drawn;
  }
  /// The sample that prepare() began.
  TexelDraw finish(const AliasTable::Drawn& drawn) const {
    const RunTexel found = lines_.find(drawn.cell, drawn.choice);
    const auto across = static_cast<std::uint32_t>(lines_.extent().width);
    return {static_cast<int>(drawn.cell % across) * kRunTexels + found.index,
            static_cast<int>(drawn.cell / across), found.fraction, drawn.column,
            drawn.mass * found.mass};
  }
  const TexelPositions& positions() const { return positions_; }

  PerSquare pdf(SquarePoint at) const {
    const int y = cell_of(at.t, positions_.extent().height);
    const int x = cell_of(at.s, positions_.extent().width);
    const std::size_t run = lines_.index(x / kRunTexels, y);
    return positions_.pdf(y, table_.mass(run) * lines_.mass(run, x % kRunTexels), at);
  }

  struct View {
    std::span<const AliasTable::Entry> runs;
    CdfLines::View lines;
    TexelPositionsView positions;
  };
  View view() const { return {table_.entries(), lines_.view(), positions_.view()}; }

  std::size_t table_bytes() const { return lines_.bytes() + table_.bytes() + positions_.bytes(); }

 private:
  AliasLines(const Grid<double>& weights, DensitySpace density_space, const Mapping& mapping);

  CdfLines lines_;
  AliasTable table_;
  TexelPositions positions_;
};
static_assert(EnvSampler<AliasLines>);

/// Draws a batch by vectors, as many whole ones as fit, from the front. Returns how many samples
/// these are.
std::size_t sample_vectors(const AliasLines::View& table, const BatchPoints& points,
                           const BatchOutput& output);

}  // namespace lightproof
