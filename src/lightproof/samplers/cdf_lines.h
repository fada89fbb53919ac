// The distribution inside every run of 32 texels of a row, in the smallest form that the run needs:
// one line of the cache with 16-bit CDF entries; where these would be too coarse, beside a lamp or
// the sun, two more with 32-bit CDF entries.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "lightproof/core/grid.h"
#include "lightproof/core/huge_pages.h"

namespace lightproof {

/// Texels of a run.
inline constexpr int kRunTexels = 32;

/// A texel of a run, found by a random number.
struct RunTexel {
  int index;        ///< the texel's index in its run
  double mass;      ///< the texel's share of the run's mass
  double fraction;  ///< share of the texel's mass that lies before the random number, in [0,1)
};

/// Upper CDF entries of a run in units of 1/kOne. From the last texel with mass on they are 1,
/// which is kept as kLast: of kOne, what an Integer holds. Narrow CDF entries that give it one unit
/// alone say so of its neighbour: they are too coarse, and not kept.
template <class Integer, std::uint32_t kOne>
struct alignas(64) RunEntries {
  static constexpr Integer kLast =
      std::min<std::uint32_t>(kOne, std::numeric_limits<Integer>::max());
  std::array<Integer, kRunTexels> upper;

  /// The texel that u, in [0,1), lies in: one with mass.
  RunTexel find(double u) const {
    const double scaled = u * kOne;
    const std::uint32_t number =
        std::min<std::uint32_t>(static_cast<std::uint32_t>(scaled), kLast - 1);
    const int index = find(number);
    const double units = high(index) - low(index);
    return {index, units / kOne, (scaled - low(index)) / units};
  }
  /// The texel of a number below kLast.
  int find(std::uint32_t number) const {
    int index = 0;
    for (const Integer entry : upper) index += entry <= number ? 1 : 0;
    return index;
  }
  /// Share of the run's mass that a texel has.
  double mass(int index) const { return (high(index) - low(index)) / kOne; }

 private:
  double high(int index) const {
    const Integer entry = upper[static_cast<std::size_t>(index)];
    return entry == kLast ? kOne : entry;
  }
  double low(int index) const { return index == 0 ? 0.0 : high(index - 1); }
};

/// All runs of a map, row by row; a row's last one may be shorter.
class CdfLines {
 public:
  explicit CdfLines(const Grid<double>& weights);

  /// How many runs a row has, and how many rows there are.
  Extent extent() const { return extent_; }
  /// Number of the run in this column of runs and this row.
  std::size_t index(int column, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(extent_.width) +
           static_cast<std::size_t>(column);
  }
  /// The texel of a run that u, in [0,1), lies in.
  RunTexel find(std::size_t run, double u) const {
    const Narrow& entries = narrow(run);
    return is_wide(entries) ? wide_[wide_index(entries)].find(u) : entries.find(u);
  }
  /// Asks the memory for a run.
  void prefetch(std::size_t run) const { __builtin_prefetch(&narrow(run)); }
  /// Share of its run's mass that a texel has; of a run without mass it says nothing.
  double mass(std::size_t run, int texel) const {
    const Narrow& entries = narrow(run);
    return is_wide(entries) ? wide_[wide_index(entries)].mass(texel) : entries.mass(texel);
  }
  std::size_t bytes() const {
    return narrow_.size() * sizeof(Narrow) + wide_.size() * sizeof(Wide);
  }
  using Narrow = RunEntries<std::uint16_t, 1U << 16U>;
  using Wide = RunEntries<std::uint32_t, 1U << 31U>;

  struct View {
    const Narrow* narrow;
    const Wide* wide;
    int runs;  ///< how many runs a row has
  };
  View view() const { return {&narrow(0), wide_.data(), extent_.width}; }

  /// The last upper CDF entry of a narrow run is 1; of a wide one all that is kept in its place is
  /// where it is. Whatever is looked for in these, what is found has the upper CDF entry 0, as in
  /// no other.
  static Narrow where_wide(std::size_t index) {
    return {{static_cast<std::uint16_t>(index), static_cast<std::uint16_t>(index >> 16U),
             Narrow::kLast}};
  }
  static bool is_wide(const Narrow& entries) { return entries.upper.back() != Narrow::kLast; }
  static std::size_t wide_index(const Narrow& entries) {
    return entries.upper[0] | std::size_t{entries.upper[1]} << 16U;
  }

  /// How many runs need the longer form.
  std::size_t wide_count() const { return wide_.size() - kBefore; }

 private:
  const Narrow& narrow(std::size_t run) const { return narrow_[kBefore + run]; }

  /// Vectors read a CDF entry together with the one before it, of a run's first one too.
  static constexpr std::size_t kBefore = 1;

  Extent extent_;
  TableVector<Narrow> narrow_;
  TableVector<Wide> wide_;
};

/// Sums of the weights of each run.
Grid<double> run_weights(const Grid<double>& weights);

}  // namespace lightproof
