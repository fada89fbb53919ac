// Walker's alias method over all texels at once, 16 bytes a texel: threshold, alias and the
// probabilities of both cells, so that one look-up draws and knows its density. O(1) a sample; not
// monotone, so it loses stratification.
#pragma once

#include "lightproof/samplers/alias_table.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/samplers/texel_positions.h"

namespace lightproof {

/// The sampler by one alias table over all texels.
class Alias {
 public:
  /// Throws InputError if the map is black.
  Alias(const EnvironmentMap& map, TargetDensity target);

  /// The texel at a point: u.s names the column of the alias table and the position over s in the
  /// texel, u.t chooses between the column's two texels and gives the position over t.
  TexelDraw draw(SquarePoint u) const { return finish(table_.column(u.s, u.t)); }
  TexelSample sample(SquarePoint u) const { return positions_.sample(draw(u)); }
  /// Begins the sample draw(u): asks the memory for what finish() reads. Other work, or the
  /// beginnings of other samples, may lie between the two.
  AliasTable::Column prepare(SquarePoint u) const {
    const AliasTable::Column column = table_.column(u.s, u.t);
    table_.prefetch(column);
    return column;
  }
  /// The sample that prepare() began.
  TexelDraw finish(const AliasTable::Column& column) const {
    const AliasTable::Drawn drawn = table_.draw(column);
    const TexelIndex texel = positions_.texel(drawn.cell);
    return {texel.x, texel.y, drawn.column, drawn.choice, drawn.mass};
  }
  const TexelPositions& positions() const { return positions_; }

  PerSquare pdf(SquarePoint at) const {
    const Extent extent = positions_.extent();
    const int y = cell_of(at.t, extent.height);
    const auto x = static_cast<std::size_t>(cell_of(at.s, extent.width));
    const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(extent.width);
    return positions_.pdf(y, table_.mass(row + x), at);
  }

  struct View {
    std::span<const AliasTable::Entry> entries;
    TexelPositionsView positions;
  };
  View view() const { return {table_.entries(), positions_.view()}; }

  std::size_t table_bytes() const { return table_.bytes() + positions_.bytes(); }

 private:
  AliasTable table_;
  TexelPositions positions_;
};
static_assert(EnvSampler<Alias>);

/// Draws a batch by vectors, as many whole ones as fit, from the front. Returns how many samples
/// these are.
std::size_t sample_vectors(const Alias::View& table, const BatchPoints& points,
                           const BatchOutput& output);

}  // namespace lightproof
