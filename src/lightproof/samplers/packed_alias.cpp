#include "lightproof/samplers/packed_alias.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "lightproof/samplers/alias_table.h"

namespace lightproof {
namespace {

/// Bits of a palette's index; a palette of floats of this size fits the first-level cache.
constexpr unsigned kCodeBits = 13;
constexpr unsigned kMostThresholdBits = 31;
/// Texels with a mass of their own.
constexpr std::size_t kOwnMasses = 1024;
constexpr unsigned kMostDigits = 12;
constexpr unsigned kWordBits = 64;

unsigned bits_of(std::uint64_t v) { return static_cast<unsigned>(std::bit_width(v)); }

/// Masses cut to so many binary digits, numbered from 0 in ascending order.
class Steps {
 public:
  explicit Steps(unsigned digits) : digits_(digits) {}

  /// log2 of the step at this mass.
  unsigned step(std::uint64_t mass) const { return std::max(bits_of(mass), digits_) - digits_; }
  std::size_t key(std::uint64_t mass) const {
    const unsigned s = step(mass);
    return (static_cast<std::size_t>(s) << (digits_ - 1)) + (mass >> s);
  }
  std::uint64_t mass(std::size_t key) const {
    const std::size_t half = std::size_t{1} << (digits_ - 1);
    if (key < 2 * half) return key;
    const std::size_t s = key / half - 1;
    return (key - s * half) << s;
  }
  std::size_t count() const { return key(~std::uint64_t{0}) + 2; }

 private:
  unsigned digits_;
};

/// The most digits for which at most `most` different masses remain, of those whose keys at
/// kMostDigits are given. Rounding may go up by one step.
unsigned digits_for(std::span<const std::size_t> keys, std::size_t most) {
  const Steps finest(kMostDigits);
  for (unsigned digits = kMostDigits;; --digits) {
    const Steps steps(digits);
    std::size_t different = 0;
    std::size_t last = 0;  // the key that is counted with its next one
    for (const std::size_t fine : keys) {
      const std::size_t key = steps.key(finest.mass(fine));
      if (different == 0 || key > last + 1) {
        different += 2;
      } else if (key == last + 1) {
        different += 1;
      }
      last = key;
    }
    if (different <= most || digits == 1) return digits;
  }
}

/// The brightest texels, at most kOwnMasses, in the order of the map.
std::vector<std::size_t> brightest(std::span<const std::uint64_t> masses,
                                   std::span<const std::size_t> counts) {
  const Steps finest(kMostDigits);
  std::size_t key = counts.size();
  std::size_t above = 0;
  while (key > 1 && above + counts[key - 1] <= kOwnMasses) above += counts[--key];
  // Those with this key or a higher one fit; some with the key below do too.
  std::size_t more = key > 1 ? kOwnMasses - above : 0;
  std::vector<std::size_t> texels;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const std::size_t k = finest.key(masses[i]);
    if (k < key && !(k + 1 == key && more > 0)) continue;
    if (k < key) --more;
    if (masses[i] > 0) texels.push_back(i);
  }
  return texels;
}

}  // namespace

MassPalette::MassPalette(std::span<const std::uint64_t> exact, unsigned bits)
    : codes(exact.size()) {
  const std::size_t size = std::size_t{1} << bits;
  if (exact.size() <= size) {
    masses.assign(exact.begin(), exact.end());
    std::iota(codes.begin(), codes.end(), std::uint16_t{0});
    return;
  }
  const Steps finest(kMostDigits);
  std::vector<std::size_t> counts(finest.count());
  for (const std::uint64_t mass : exact) ++counts[finest.key(mass)];
  const std::vector<std::size_t> own = brightest(exact, counts);
  std::vector<std::size_t> used;
  for (std::size_t key = 0; key < counts.size(); ++key) {
    if (counts[key] > 0) used.push_back(key);
  }
  const Steps steps(digits_for(used, size - kOwnMasses));
  std::vector<std::uint64_t> rounded(exact.begin(), exact.end());
  std::vector<std::uint16_t> code_of(steps.count());
  std::array<std::uint64_t, kWordBits> carry{};
  auto next_own = own.begin();
  for (std::size_t i = 0; i < rounded.size(); ++i) {
    if (next_own != own.end() && *next_own == i) {
      ++next_own;
      continue;
    }
    const unsigned step = steps.step(rounded[i]);
    const std::uint64_t mass = rounded[i] + carry[step];
    rounded[i] = mass >> step << step;
    carry[step] = mass - rounded[i];
    code_of[steps.key(rounded[i])] = 1;
  }
  for (std::size_t key = 0; key < code_of.size(); ++key) {
    if (code_of[key] == 0) continue;
    code_of[key] = static_cast<std::uint16_t>(masses.size());
    masses.push_back(steps.mass(key));
  }
  for (std::size_t i = 0; i < rounded.size(); ++i) codes[i] = code_of[steps.key(rounded[i])];
  const std::uint64_t left = std::accumulate(carry.begin(), carry.end(), std::uint64_t{0});
  for (std::size_t k = 0; k < own.size(); ++k) {
    codes[own[k]] = static_cast<std::uint16_t>(masses.size());
    const std::uint64_t more = left / own.size() + (k < left % own.size() ? 1 : 0);
    masses.push_back(exact[own[k]] + more);
  }
}

PackedAliasLayout::PackedAliasLayout(std::size_t texels)
    : alias_at(std::max(1U, bits_of(texels - 1))) {
  code_bits = std::min(alias_at, kCodeBits);
  threshold_bits = std::min(kWordBits - alias_at - 2 * code_bits, kMostThresholdBits);
  own_at = alias_at + code_bits;
  threshold_at = own_at + code_bits;
  alias_mask = (std::uint64_t{1} << alias_at) - 1;
  code_mask = (std::uint64_t{1} << code_bits) - 1;
  unit = std::ldexp(1.0, -static_cast<int>(threshold_bits));
}

PackedAlias::PackedAlias(const EnvironmentMap& map, TargetDensity target)
    : places_(map.radiance.extent(), target.weighting),
      layout_(map.radiance.extent().count()),
      words_(map.radiance.extent().count()) {
  const unsigned threshold_bits = layout_.threshold_bits;
  TableVector<std::uint64_t> masses = whole_masses(CellWeights(map, target), threshold_bits);
  const MassPalette palette(masses, layout_.code_bits);
  for (std::size_t i = 0; i < masses.size(); ++i) masses[i] = palette.masses[palette.codes[i]];
  const double probability = layout_.unit / static_cast<double>(words_.size());
  for (const std::uint64_t mass : palette.masses) {
    palette_.push_back(static_cast<float>(probability * static_cast<double>(mass)));
  }
  AliasSweep(masses, threshold_bits).for_columns([&](std::size_t cell, const AliasColumn& column) {
    words_[cell] = column.alias | std::uint64_t{palette.codes[column.alias]} << layout_.alias_at |
                   std::uint64_t{palette.codes[cell]} << layout_.own_at |
                   column.threshold << layout_.threshold_at;
  });
}

}  // namespace lightproof
