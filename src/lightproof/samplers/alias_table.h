// Walker's alias method (Walker 1974, "New fast method for generating discrete random numbers with
// arbitrary frequency distributions") over any cells: one number names a column, another chooses
// between its two cells. O(1) a draw, and not monotone: neighbouring random numbers go to unrelated
// cells.
//
// Masses are whole numbers, so that the table draws exactly what it says; a cell of positive weight
// keeps at least one unit.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lightproof/core/large_pages.h"

namespace lightproof {

/// Masses in units of 2^-bits / weights.size(), that is with a sum of weights.size() << bits.
/// Positive weights of less than one unit get one; the others share the rest in proportion, to
/// within one unit, but for the largest, which takes what the rounding of the sum leaves: less than
/// a unit of every 65536 cells. In parallel, the same for any number of threads. All weights are >=
/// 0 and one is positive; (weights.size() << bits) < 2^62.
std::vector<std::uint64_t> whole_masses(std::span<const double> weights, unsigned bits);

/// A column of the method: its own cell below the threshold, else the alias.
struct AliasColumn {
  std::uint64_t
      threshold;  ///< in [0, 2^bits); 0 if the alias, which may be the cell itself, is all
  std::uint64_t alias;
};

/// Calls take(column index, AliasColumn) for every column of a table that draws these masses, of
/// sum masses.size() << bits: two pointers sweep the cells below and above the average once,
/// without queues or rounding.
template <class Take>
void sweep_aliases(std::span<const std::uint64_t> masses, unsigned bits, const Take& take) {
  const std::uint64_t full = std::uint64_t{1} << bits;
  const auto next_large = [&](std::size_t i) {
    while (i < masses.size() && masses[i] < full) ++i;
    return i;
  };
  std::size_t large = next_large(0);
  std::uint64_t left = large < masses.size() ? masses[large] : 0;  // of the large one
  for (std::size_t small = 0; small < masses.size(); ++small) {
    if (masses[small] >= full) continue;
    take(small, AliasColumn{masses[small], large});
    left -= full - masses[small];
    // What has fallen below the average is filled up by the next.
    while (left < full) {
      const std::size_t next = next_large(large + 1);
      if (next == masses.size()) break;
      take(large, AliasColumn{left, next});
      left += masses[next] - full;
      large = next;
    }
  }
  for (; large < masses.size(); large = next_large(large + 1)) take(large, AliasColumn{0, large});
}

/// What is left of a uniform number in [0,1) that has chosen the part below or above `share`: a
/// uniform one in [0,1).
inline double rest_of_choice(double choice, double share) {
  if (choice < share) return choice / share;
  return std::min((choice - share) / (1.0 - share), 1.0 - 0x1p-53);  // which may round to 1
}

/// The method with entries of 16 bytes.
class AliasTable {
 public:
  /// Weights >= 0, one of them positive; at most 2^31 - 1.
  explicit AliasTable(std::span<const double> weights);

  struct Drawn {
    std::uint32_t cell;
    double mass;    ///< its probability, to 2^-24 of itself
    double column;  ///< uniform in [0,1), independent of the cell and of `choice`
    double choice;  ///< likewise
  };
  /// Of two uniform numbers in [0,1).
  Drawn draw(double column, double choice) const {
    const double scaled = column * static_cast<double>(entries_.size());
    const auto index = static_cast<std::uint32_t>(scaled);
    const Entry& entry = entries_[index];
    const double share = entry.threshold * kUnit;
    const bool own = choice < share;
    return {own ? index : entry.alias, static_cast<double>(own ? entry.mass : entry.alias_mass),
            scaled - index, rest_of_choice(choice, share)};
  }

  double mass(std::size_t cell) const { return static_cast<double>(entries_[cell].mass); }
  std::size_t bytes() const { return entries_.size() * sizeof(Entry); }

  struct Entry {
    std::uint32_t threshold;  ///< in units of 2^-31
    std::uint32_t alias;
    float mass;
    float alias_mass;
  };
  std::span<const Entry> entries() const { return entries_; }

 private:
  static constexpr unsigned kBits = 31;
  static constexpr double kUnit = 0x1p-31;

  TableVector<Entry> entries_;
};

}  // namespace lightproof
