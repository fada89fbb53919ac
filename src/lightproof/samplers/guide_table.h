// Inversion through a guide table (Chen and Asau 1974, "On generating random variates from an
// empirical distribution"): the first bits of the random number name a cell to begin with, and
// bisection of the CDF entries up to the next one's cell finds the right one. On average O(1) per
// sample, never worse than O(log W + log H): a scan inside a guide's cell would be, under a sun.
// Texel for texel the same as LinearScan.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lightproof/core/huge_pages.h"
#include "lightproof/samplers/batch.h"
#include "lightproof/samplers/cdf_inversion.h"

namespace lightproof {

/// Guide tables of several distributions of the same number of cells, at most 65536: the cell that
/// every 2^bits-th part of [0,1) begins in.
class Guides {
 public:
  /// `parts_per_cell` is a power of two: the more there are, the more often the first cell is the
  /// one that is sought, or the next. Throws InputError if there are more than 65536 cells.
  Guides(std::size_t count, std::size_t cells, std::size_t parts_per_cell);
  /// Sets one guide table to a distribution.
  void set(std::size_t guide, CdfEntries entries);
  /// The cell that u lies in, of the distribution to whose CDF entries this guide was set.
  CdfCell find(std::size_t guide, CdfEntries entries, std::uint32_t u) const {
    const View all = view();
    const std::size_t cell = all.find(all.part(guide, u), entries.data(), u);
    return {entries[cell], entries[cell + 1], static_cast<int>(cell)};
  }

  struct View {
    unsigned shift;
    std::size_t parts;  ///< numbers of one guide table: a part each, and its end
    const std::uint16_t* first;

    /// The part of a guide that u lies in.
    std::size_t part(std::size_t guide, std::uint32_t u) const {
      return guide * parts + (u >> shift);
    }
    /// The cell of a part that u lies in, by bisection from a cell on that u lies in or after.
    std::size_t find_from(std::size_t cell, std::size_t part, const std::uint32_t* entries,
                          std::uint32_t u) const {
      for (std::size_t cells = first[part + 1] - cell + 1; cells > 1;) {
        const std::size_t half = cells / 2;
        cell += entries[cell + half] <= u ? half : 0;
        cells -= half;
      }
      return cell;
    }
    /// The cell of a part that u lies in. No CDF entry is read, and waited for, where the part has
    /// one cell alone.
    std::size_t find(std::size_t part, const std::uint32_t* entries, std::uint32_t u) const {
      return find_from(first[part], part, entries, u);
    }
  };
  View view() const { return {shift_, parts_, first_.data()}; }
  /// Asks the memory for the part of a guide that u lies in.
  void prefetch(std::size_t guide, std::uint32_t u) const {
    __builtin_prefetch(&first_[view().part(guide, u)]);
  }
  std::size_t bytes() const { return first_.size() * sizeof(std::uint16_t); }

 private:
  unsigned shift_;
  std::size_t parts_;
  TableVector<std::uint16_t> first_;
};

/// Guide tables beside the CDF entries of a table, for its rows and its columns.
class GuidedEntries {
 public:
  /// Makes the guides of a table; those of columns have so many parts a cell, those of rows, which
  /// are few, more.
  explicit GuidedEntries(const CdfTable& table, std::size_t parts_per_column = 1);
  CdfCell row(const CdfTable& table, std::uint32_t u) const {
    return rows_.find(0, table.rows(), u);
  }
  CdfCell column(const CdfTable& table, int y, std::uint32_t u) const {
    return columns_.find(static_cast<std::size_t>(y), table.columns(y), u);
  }
  /// Asks the memory for the part of row y's guide that u lies in.
  void prefetch_column(int y, std::uint32_t u) const {
    columns_.prefetch(static_cast<std::size_t>(y), u);
  }
  std::size_t bytes() const { return rows_.bytes() + columns_.bytes(); }

  struct View {
    Guides::View rows;
    Guides::View columns;
  };
  View view() const { return {rows_.view(), columns_.view()}; }

 private:
  Guides rows_;
  Guides columns_;
};

using GuideTable = CdfInversion<GuidedEntries>;
using GuideTableView = CdfInversionView<GuidedEntries::View>;
static_assert(EnvSampler<GuideTable>);

/// Draws a batch by vectors, as many whole ones as fit, from the front. Returns how many samples
/// these are.
std::size_t sample_vectors(const GuideTableView& table, const BatchPoints& points,
                           const BatchOutput& output);

}  // namespace lightproof
