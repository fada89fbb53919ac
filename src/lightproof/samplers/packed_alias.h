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
  TexelDraw draw(SquarePoint u) const {
    const double scaled = u.s * to_double(words_.size());
    const auto column = static_cast<std::int64_t>(scaled);
    const std::uint64_t word = words_[static_cast<std::size_t>(column)];
    const double share = layout_.unit * to_double(word >> layout_.threshold_at);
    const bool own = u.t < share;
    const std::uint64_t cell =
        select(own, static_cast<std::uint64_t>(column), word & layout_.alias_mask);
    const double mass = palette_mass(select(own, word >> layout_.own_at, word >> layout_.alias_at));
    const TexelIndex texel = positions_.texel(cell);
    return {texel.x, texel.y, scaled - static_cast<double>(column), rest_of_choice(u.t, share),
            mass};
  }
  TexelSample sample(SquarePoint u) const { return positions_.sample(draw(u)); }
  /// Asks the memory for what draw(u) reads.
  void prefetch(SquarePoint u) const {
    __builtin_prefetch(&words_[static_cast<std::size_t>(
        static_cast<std::int64_t>(u.s * to_double(words_.size())))]);
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
  double palette_mass(std::uint64_t code) const {
    return static_cast<double>(palette_[code & layout_.code_mask]);
  }

  TexelPositions positions_;
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
