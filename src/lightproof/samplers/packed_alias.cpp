#include "lightproof/samplers/packed_alias.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lightproof/samplers/alias_table.h"
#include "lightproof/samplers/mass_palette.h"

namespace lightproof {
namespace {

/// Bits of a palette's index; a palette of floats of this size fits the first-level cache.
constexpr unsigned kCodeBits = 13;
constexpr unsigned kMostThresholdBits = 31;
constexpr unsigned kWordBits = 64;

}  // namespace

PackedAliasLayout::PackedAliasLayout(std::size_t texels)
    : alias_at(std::max(1U, static_cast<unsigned>(std::bit_width(texels - 1)))) {
  code_bits = std::min(alias_at, kCodeBits);
  threshold_bits = std::min(kWordBits - alias_at - 2 * code_bits, kMostThresholdBits);
  own_at = alias_at + code_bits;
  threshold_at = own_at + code_bits;
  alias_mask = (std::uint64_t{1} << alias_at) - 1;
  code_mask = (std::uint64_t{1} << code_bits) - 1;
  unit = std::ldexp(1.0, -static_cast<int>(threshold_bits));
}

PackedAlias::PackedAlias(const EnvironmentMap& map, TargetDensity target)
    : positions_(map.radiance.extent(), target.density_space, map.mapping),
      columns_(static_cast<double>(map.radiance.extent().count())),
      layout_(map.radiance.extent().count()),
      words_(map.radiance.extent().count()) {
  const unsigned threshold_bits = layout_.threshold_bits;
  const MassPalette palette(whole_masses(CellWeights(map, target), threshold_bits),
                            layout_.code_bits);
  const double unit = layout_.unit / static_cast<double>(words_.size());
  for (const std::uint64_t mass : palette.masses) palette_.push_back(to_probability(mass, unit));
  AliasSweep(palette.cells, threshold_bits)
      .for_columns([&](std::size_t cell, const AliasColumn& column) {
        words_[cell] = column.alias |
                       std::uint64_t{palette.codes[column.alias]} << layout_.alias_at |
                       std::uint64_t{palette.codes[cell]} << layout_.own_at |
                       column.threshold << layout_.threshold_at;
      });
}

}  // namespace lightproof
