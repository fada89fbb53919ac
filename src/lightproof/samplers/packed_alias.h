// Walker's alias method over all texels with one 64-bit word a texel: threshold, alias, and the
// probabilities of both cells as indices of a palette. O(1) a sample; not monotone, so it loses
// stratification.
//
// Texels are rounded to the palette's masses before the table is built from these, in whole
// numbers: what is returned is the density that is drawn. The brightest texels have masses of their
// own; the others are rounded up and down by turns, so that no stretch of the map gains.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lightproof/core/huge_pages.h"
#include "lightproof/samplers/alias_table.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/samplers/texel_positions.h"

namespace lightproof {

/// Where the parts of a word lie, from the lowest bit: alias, alias's code, own code, threshold.
struct PackedAliasLayout {
  unsigned code_bits;
  unsigned threshold_bits;
  unsigned alias_at;      ///< first bit of the alias's code
  unsigned own_at;        ///< first bit of the own code
  unsigned threshold_at;  ///< first bit of the threshold
  std::uint64_t alias_mask;
  std::uint64_t code_mask;
  double unit;  ///< the share of a column that one unit of the threshold is

  /// The layout for a table of so many texels; the threshold gets the bits that the other parts
  /// leave.
  explicit PackedAliasLayout(std::size_t texels);
};

/// The sampler by an alias table of one word a texel.
class PackedAlias {
 public:
  /// Throws InputError if the map is black.
  PackedAlias(const EnvironmentMap& map, TargetDensity target);

  /// The texel at a point: u.s names the column of the alias table and the position over s in the
  /// texel, u.t chooses between the column's two texels and gives the position over t.
  TexelDraw draw(SquarePoint u) const { return finish(column_of(u)); }
  TexelSample sample(SquarePoint u) const { return positions_.sample(draw(u)); }

  /// A column of the table, and what is left of the two random numbers.
  struct Column {
    std::int64_t index;
    double rest;    ///< of the number that names the column
    double choice;  ///< the number that chooses in it
  };
  /// Begins the sample draw(u): asks the memory for what finish() reads. Other work, or the
  /// beginnings of other samples, may lie between the two.
  Column prepare(SquarePoint u) const {
    const Column column = column_of(u);
    __builtin_prefetch(&words_[static_cast<std::size_t>(column.index)]);
    return column;
  }
  /// The sample that prepare() began.
  TexelDraw finish(const Column& column) const {
    const std::uint64_t word = words_[static_cast<std::size_t>(column.index)];
    const double share = layout_.unit * to_double(word >> layout_.threshold_at);
    const bool own = column.choice < share;
    const std::uint64_t cell =
        select(own, static_cast<std::uint64_t>(column.index), word & layout_.alias_mask);
    const double mass = palette_mass(select(own, word >> layout_.own_at, word >> layout_.alias_at));
    const TexelIndex texel = positions_.texel(cell);
    return {texel.x, texel.y, column.rest, rest_of_choice(column.choice, share), mass};
  }
  const TexelPositions& positions() const { return positions_; }

  PerSquare pdf(SquarePoint at) const {
    const Extent extent = positions_.extent();
    const int y = cell_of(at.t, extent.height);
    const auto x = static_cast<std::size_t>(cell_of(at.s, extent.width));
    const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(extent.width);
    return positions_.pdf(y, palette_mass(words_[row + x] >> layout_.own_at), at);
  }

  struct View {
    std::span<const std::uint64_t> words;
    std::span<const float> palette;
    PackedAliasLayout layout;
    TexelPositionsView positions;
  };
  View view() const { return {words_, palette_, layout_, positions_.view()}; }

  std::size_t table_bytes() const {
    return words_.size() * sizeof(std::uint64_t) + palette_.size() * sizeof(float) +
           positions_.bytes();
  }

 private:
  Column column_of(SquarePoint u) const {
    const double scaled = below_one(u.s) * columns_;
    const auto index = static_cast<std::int64_t>(scaled);
    return {index, scaled - static_cast<double>(index), below_one(u.t)};
  }
  double palette_mass(std::uint64_t code) const {
    return static_cast<double>(palette_[code & layout_.code_mask]);
  }

  TexelPositions positions_;
  double columns_;  ///< how many the table has
  PackedAliasLayout layout_;
  TableVector<std::uint64_t> words_;
  std::vector<float> palette_;  ///< probabilities, to 2^-24 of themselves
};
static_assert(EnvSampler<PackedAlias>);

/// Draws a batch by vectors, as many whole ones as fit, from the front. Returns how many samples
/// these are.
std::size_t sample_vectors(const PackedAlias::View& table, const BatchPoints& points,
                           const BatchOutput& output);

}  // namespace lightproof
