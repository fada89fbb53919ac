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

#include "lightproof/core/huge_pages.h"
#include "lightproof/core/parallel.h"
#include "lightproof/core/select.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/samplers/texel_weights.h"
#include "lightproof/samplers/weight_vectors.h"

namespace lightproof {

/// The masses of cells as whole numbers in units of 2^-bits / weights.count(), that is with a sum
/// of weights.count() << bits. Positive weights of less than one unit get one; the others share the
/// rest in proportion, to within one unit and the precision of their shares: 2^-20 of a unit (more
/// if the sum is 2^42 or more), and 2^-53 of the share. What that leaves of the sum goes to the
/// largest of every 65536 cells, if it is at least half the average, in proportion to their masses:
/// that changes none by more than some 2^-bits of itself, which is why there are at least 4 bits.
/// Computed in parallel, with the same result for any number of threads. All weights are >= 0 and
/// one is positive; (weights.count() << bits) < 2^62.
TableVector<std::uint64_t> whole_masses(const CellWeights& weights, unsigned bits);

/// A column of an alias table: its own cell below the threshold, else the alias.
struct AliasColumn {
  /// In [0, 2^bits); 0 if the alias, which may be the cell itself, is all.
  std::uint64_t threshold;
  std::uint64_t alias;

  friend bool operator==(const AliasColumn&, const AliasColumn&) = default;
};

/// Neighbouring cells of at most the average mass, whose columns share one alias.
struct AliasRun {
  std::size_t first;
  std::span<const std::uint64_t> masses;
  std::size_t alias;  ///< the number of all cells, if none is above the average and so none below

  AliasColumn column(std::size_t i, std::uint64_t full) const {
    return masses[i] < full ? AliasColumn{masses[i], alias} : AliasColumn{0, first + i};
  }
};

/// The pairing of the cells below the average mass with those above it: two pointers sweep both
/// once, without queues or rounding. Where they stand at any cell follows from what the cells
/// before it lack of the average, so the sweep goes on in many places at once (Huebschle-Schneider
/// and Sanders 2019, "Parallel weighted random sampling"), and gives the same table for any number
/// of threads.
class AliasSweep {
 public:
  /// Prepares the pairing of masses whose sum is masses.size() << bits, and which outlive this.
  AliasSweep(std::span<const std::uint64_t> masses, unsigned bits);

  /// Calls take(column index, AliasColumn) once for every column, from several threads.
  template <class Take>
  void for_columns(const Take& take) const {
    for_columns(take, [&](const AliasRun& run) {
      for (std::size_t i = 0; i < run.masses.size(); ++i) {
        take(run.first + i, run.column(i, full_));
      }
    });
  }
  /// Calls take(column index, AliasColumn) once for every column, from several threads, but
  /// take_run(AliasRun) for the columns of a whole stretch where one alias is enough for it.
  template <class Take, class TakeRun>
  void for_columns(const Take& take, const TakeRun& take_run) const {
    parallel_chunks(masses_.size(), kTask,
                    [&](std::size_t /*task*/, std::size_t first, std::size_t end) {
                      sweep(first, end, take, take_run);
                    });
  }

 private:
  /// A cell above the average, and what is left of it: at least the average. Where there is none,
  /// the cell behind the last.
  struct Filling {
    std::size_t large;
    std::uint64_t left;
  };

  /// What fills the columns of the small cells from the first of a stretch on.
  Filling start_of(std::size_t stretch) const;
  /// The first cell above the average from this one on.
  std::size_t next_large(std::size_t cell) const;
  bool has_large(std::size_t stretch) const {
    return before_[stretch + 1].excess > before_[stretch].excess;
  }
  std::uint64_t lack_of(std::size_t stretch) const {
    return before_[stretch + 1].lack - before_[stretch].lack;
  }

  /// The columns of the small cells from one to another, and of the large ones that they use up.
  template <class Take, class TakeRun>
  void sweep(std::size_t first, std::size_t end, const Take& take, const TakeRun& take_run) const {
    Filling filling = start_of(first / kStretch);
    for (std::size_t stretch = first / kStretch; first < end; ++stretch, first += kStretch) {
      const auto masses = masses_.subspan(first, std::min(kStretch, end - first));
      const std::uint64_t lack = lack_of(stretch);
      if (!has_large(stretch) && lack <= filling.left - full_) {
        take_run(AliasRun{first, masses, filling.large});
        filling.left -= lack;
      } else {
        fill(first, masses, filling, take);
      }
    }
    if (end == masses_.size() && filling.large < end) {
      take(filling.large, AliasColumn{0, filling.large});
    }
  }

  /// The columns of a stretch of cells that one alias is not enough for.
  template <class Take>
  void fill(std::size_t first, std::span<const std::uint64_t> masses, Filling& filling,
            const Take& take) const {
    for (std::size_t i = 0; i < masses.size(); ++i) {
      if (masses[i] > full_) continue;
      const std::size_t cell = first + i;
      if (masses[i] == full_) {
        take(cell, AliasColumn{0, cell});
        continue;
      }
      take(cell, AliasColumn{masses[i], filling.large});
      filling.left -= full_ - masses[i];
      // What has fallen below the average is filled up by the next.
      while (filling.left < full_) {
        const std::size_t next = next_large(filling.large + 1);
        take(filling.large, AliasColumn{filling.left, next});
        filling.left += masses_[next] - full_;
        filling.large = next;
      }
    }
  }

  /// Cells whose balance is known, and cells of one task: fixed, so that the split does not depend
  /// on the threads.
  static constexpr std::size_t kStretch = std::size_t{1} << 9U;
  static constexpr std::size_t kTask = kTaskCells;
  static_assert(kTask % kStretch == 0);

  std::span<const std::uint64_t> masses_;
  std::uint64_t full_;
  std::vector<Balance> before_;  ///< each stretch, of all cells; and of all, at the end
};

/// The probability of a mass, given that of one unit, as tables store it: rounded to 2^-24 of
/// itself. Masses below 2^63.
inline float to_probability(std::uint64_t mass, double unit) {
  // Quicker of signed numbers.
  return static_cast<float>(unit * static_cast<double>(static_cast<std::int64_t>(mass)));
}

/// What is left of a uniform number in [0,1) that has chosen the part below or above `share`: a
/// uniform one in [0,1).
inline double rest_of_choice(double choice, double share) {
  const bool below = choice < share;
  const double part = select(below, choice, choice - share);
  return std::min(part / select(below, share, 1.0 - share), 1.0 - 0x1p-53);  // which may round to 1
}

/// An alias table over any cells, with entries of 16 bytes.
class AliasTable {
 public:
  /// Builds the table of weights >= 0, one of them positive; at most 2^31 - 1 of them.
  explicit AliasTable(const CellWeights& weights);

  /// A cell that was drawn, and what is left of the two random numbers.
  struct Drawn {
    std::uint32_t cell;
    double mass;    ///< the cell's probability, to 2^-24 of itself
    double column;  ///< uniform in [0,1), independent of the cell and of `choice`
    double choice;  ///< uniform in [0,1), independent of the cell and of `column`
  };
  /// Where a draw reads, and what is left of its numbers.
  struct Column {
    std::uint32_t index;
    double rest;    ///< of the number that names the column, uniform in [0,1)
    double choice;  ///< the number that chooses in it
  };
  /// The column of two uniform numbers in [0,1): one names it, one chooses in it.
  Column column(double number, double choice) const {
    const double scaled = below_one(number) * static_cast<double>(entries_.size());
    const auto index = static_cast<std::uint32_t>(scaled);
    return {index, scaled - index, below_one(choice)};
  }
  /// Asks the memory for a column.
  void prefetch(const Column& column) const { __builtin_prefetch(&entries_[column.index]); }
  /// Draws a cell of a column.
  Drawn draw(const Column& column) const {
    const Entry& entry = entries_[column.index];
    const double share = entry.threshold * kUnit;
    const bool own = column.choice < share;
    return {select(own, column.index, entry.alias),
            select(own, static_cast<double>(entry.mass), static_cast<double>(entry.alias_mass)),
            column.rest, rest_of_choice(column.choice, share)};
  }
  /// Draws a cell by two uniform numbers in [0,1): one names a column, one chooses in it.
  Drawn draw(double number, double choice) const { return draw(column(number, choice)); }

  /// Probability of a cell, to 2^-24 of itself.
  double mass(std::size_t cell) const { return static_cast<double>(entries_[cell].mass); }
  std::size_t bytes() const { return entries_.size() * sizeof(Entry); }

  /// A column, and the probabilities of its cells.
  struct Entry {
    std::uint32_t threshold;  ///< share of the column's own cell, in units of 2^-31
    std::uint32_t alias;
    float mass;        ///< probability of the column's own cell
    float alias_mass;  ///< probability of the alias
  };
  std::span<const Entry> entries() const { return entries_; }

  static constexpr unsigned kBits = 31;

 private:
  static constexpr double kUnit = 0x1p-31;

  TableVector<Entry> entries_;
};

/// Writes the entries of a run, as many as it has masses, by vectors; `unit` is the probability of
/// one unit of mass. Returns how many entries vectors wrote, from the front: 0 on a processor
/// without vectors.
std::size_t write_entries(const AliasRun& run, double unit, float alias_mass,
                          std::span<AliasTable::Entry> entries);

}  // namespace lightproof
