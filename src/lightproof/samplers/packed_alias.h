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

#include "lightproof/samplers/alias_table.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/samplers/texel_places.h"

namespace lightproof {

/// Masses of which at most 2^bits are different.
struct MassPalette {
  std::vector<std::uint64_t> masses;
  std::vector<std::uint16_t> codes;  ///< of every texel, indices of `masses`

  /// Rounds masses; their sum stays what it was, and what is positive stays so. 11 to 16
  /// bits; fewer only if there are no more masses than codes.
  MassPalette(std::span<const std::uint64_t> exact, unsigned bits);
};

class PackedAlias {
 public:
  /// Throws InputError if the map is black.
  PackedAlias(const EnvironmentMap& map, TargetDensity target);

  /// u.s names the column and the place across, u.t chooses, and gives the place along.
  TexelSample sample(SquarePoint u) const {
    const double scaled = u.s * static_cast<double>(words_.size());
    const auto column = static_cast<std::uint64_t>(scaled);
    const std::uint64_t word = words_[column];
    const double share = unit_ * static_cast<double>(word >> threshold_at_);
    const bool own = u.t < share;
    const std::uint64_t cell = own ? column : word & alias_mask_;
    const double mass = palette_mass(word >> (own ? own_at_ : alias_at_));
    const auto width = static_cast<std::uint64_t>(places_.extent().width);
    return places_.sample(static_cast<int>(cell % width), static_cast<int>(cell / width),
                          scaled - static_cast<double>(column), rest_of_choice(u.t, share), mass);
  }

  PerSquare pdf(SquarePoint at) const {
    const Extent extent = places_.extent();
    const int y = cell_of(at.t, extent.height);
    const auto x = static_cast<std::size_t>(cell_of(at.s, extent.width));
    const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(extent.width);
    return places_.pdf(y, palette_mass(words_[row + x] >> own_at_), at);
  }

  std::size_t table_bytes() const {
    return words_.size() * sizeof(std::uint64_t) + palette_.size() * sizeof(float) +
           places_.bytes();
  }

 private:
  double palette_mass(std::uint64_t code) const {
    return static_cast<double>(palette_[code & code_mask_]);
  }

  TexelPlaces places_;
  std::vector<std::uint64_t>
      words_;                   ///< from the lowest bit: alias, alias's code, own code, threshold
  std::vector<float> palette_;  ///< probabilities, to 2^-24 of themselves
  unsigned alias_at_;           ///< first bits of the codes and of the threshold
  unsigned own_at_;
  unsigned threshold_at_;
  std::uint64_t alias_mask_;
  std::uint64_t code_mask_;
  double unit_;  ///< of the threshold
};
static_assert(EnvSampler<PackedAlias>);

}  // namespace lightproof
