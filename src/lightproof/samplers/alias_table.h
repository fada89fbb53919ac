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
#include "lightproof/core/parallel.h"

namespace lightproof {

/// Masses in units of 2^-bits / weights.size(), that is with a sum of weights.size() << bits.
/// Positive weights of less than one unit get one; the others share the rest in proportion, to
/// within one unit and the precision of their shares: 2^-20 of a unit (more if the sum is 2^42 or
/// more), and 2^-53 of the share. What that leaves of the sum goes to the largest of every 65536
/// cells, if it is at least half the average, in proportion to their masses: that changes none by
/// more than some 2^-bits of itself, which is why there are at least 4 bits. In parallel, the same
/// for any number of threads. All weights are >= 0 and one is positive;
/// (weights.size() << bits) < 2^62.
TableVector<std::uint64_t> whole_masses(std::span<const double> weights, unsigned bits);

/// A column of the method: its own cell below the threshold, else the alias.
struct AliasColumn {
  std::uint64_t
      threshold;  ///< in [0, 2^bits); 0 if the alias, which may be the cell itself, is all
  std::uint64_t alias;

  friend bool operator==(const AliasColumn&, const AliasColumn&) = default;
};

/// The pairing of the cells below the average mass with those above it: two pointers sweep both
/// once, without queues or rounding. Where they stand at any cell follows from what the cells
/// before it lack of the average, so the sweep goes on in many places at once (Huebschle-Schneider
/// and Sanders 2019, "Parallel weighted random sampling"), and gives the same table for any number
/// of threads.
class AliasSweep {
 public:
  /// Masses of sum masses.size() << bits, which outlive this.
  AliasSweep(std::span<const std::uint64_t> masses, unsigned bits);

  /// Calls take(column index, AliasColumn) once for every column, from several threads.
  template <class Take>
  void for_columns(const Take& take) const {
    parallel_for((masses_.size() + kTask - 1) / kTask, [&](std::size_t task) {
      sweep(task * kTask, std::min(masses_.size(), (task + 1) * kTask), take);
    });
  }

 private:
  /// A large cell, and what is left of it; at least the average.
  struct Filling {
    std::size_t large;
    std::uint64_t left;
  };
  /// What cells lack of the average, and what they have above it.
  struct Balance {
    std::uint64_t lack;
    std::uint64_t excess;
  };

  Balance balance(std::size_t first, std::size_t end) const;
  /// What fills the columns of the small cells from the first of a stretch on.
  Filling start_of(std::size_t stretch) const;
  std::size_t next_large(std::size_t cell) const {
    while (cell < masses_.size() && masses_[cell] < full_) ++cell;
    return cell;
  }

  /// The columns of the small cells from one to another, and of the large ones that they use up.
  template <class Take>
  void sweep(std::size_t first, std::size_t end, const Take& take) const {
    auto [large, left] = start_of(first / kStretch);
    for (std::size_t small = first; small < end; ++small) {
      if (masses_[small] >= full_) continue;
      take(small, AliasColumn{masses_[small], large});
      left -= full_ - masses_[small];
      // What has fallen below the average is filled up by the next.
      while (left < full_) {
        const std::size_t next = next_large(large + 1);
        take(large, AliasColumn{left, next});
        left += masses_[next] - full_;
        large = next;
      }
    }
    if (end < masses_.size()) return;
    for (; large < end; large = next_large(large + 1)) take(large, AliasColumn{0, large});
  }

  /// Cells whose balance is known, and cells of one task: fixed, so that the split does not depend
  /// on the threads.
  static constexpr std::size_t kStretch = std::size_t{1} << 11U;
  static constexpr std::size_t kTask = 32 * kStretch;

  std::span<const std::uint64_t> masses_;
  std::uint64_t full_;
  std::vector<Balance> before_;  ///< each stretch, of all cells
};

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
