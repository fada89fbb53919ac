// Inversion of a CdfTable: first the row, then the column in it. What differs between methods is
// only how the cell is found; for the same point all of them return the same texel.
#pragma once

#include <concepts>
#include <cstdint>

#include "lightproof/samplers/cdf_table.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/samplers/texel_positions.h"

namespace lightproof {

/// The cell of a distribution that a number u lies in: low <= u < high, its CDF entries in units of
/// 2^-31. They come first: a pair that is read at once is then returned in one register, and
/// does not take a way through memory whose parts the processor would wait for.
struct CdfCell {
  std::uint32_t low;
  std::uint32_t high;
  int index;

  /// The cell's mass in units of 2^-31.
  double units() const { return static_cast<double>(high - low); }
  /// How much of the cell's mass lies before u, as a share in [0,1); u in units of 2^-31.
  double fraction(double u) const { return (u - low) / units(); }
};

/// Finds the first cell whose upper CDF entry lies above u, u < kCdfOne, with whatever it keeps
/// beside the table. Cells without mass are never found.
template <class T>
concept CellFinder = requires(const T finder, const CdfTable& table, int y, std::uint32_t u) {
  T(table);
  { finder.row(table, u) } -> std::same_as<CdfCell>;
  { finder.column(table, y, u) } -> std::same_as<CdfCell>;
  { finder.bytes() } -> std::same_as<std::size_t>;
};

/// What an inversion sampler keeps, for code that works on many samples at once.
template <class FinderView>
struct CdfInversionView {
  CdfTable::View table;
  FinderView finder;
  TexelPositionsView positions;
};

/// The inversion sampler with this way of finding a cell. It is monotone and keeps stratification.
template <CellFinder Finder>
class CdfInversion {
 public:
  CdfInversion(const EnvironmentMap& map, TargetDensity target)
      : table_(map, target),
        finder_(table_),
        positions_(table_.extent(), target.density_space, map.mapping) {}

  TexelDraw draw(SquarePoint u) const { return finish(row_of(u)); }
  TexelSample sample(SquarePoint u) const { return positions_.sample(draw(u)); }

  /// A row, and what is left of the two random numbers.
  struct Row {
    int index;
    double units;         ///< its mass in units of 2^-31
    double row_fraction;  ///< share of its mass that lies before u.t
    double scaled_s;      ///< u.s in units of 2^-31
  };
  /// Begins the sample draw(u): asks the memory for where finish() begins to search the row, which
  /// itself is searched for that. Other work, or the beginnings of other samples, may lie between
  /// the two.
  Row prepare(SquarePoint u) const requires requires(const Finder& finder) {
    finder.prefetch_column(0, std::uint32_t{});
  }
  {
    const Row row = row_of(u);
    finder_.prefetch_column(row.index, static_cast<std::uint32_t>(row.scaled_s));
    return row;
  }
  /// The sample that prepare() began.
  TexelDraw finish(const Row& row) const {
    const CdfCell column =
        finder_.column(table_, row.index, static_cast<std::uint32_t>(row.scaled_s));
    return {column.index, row.index, column.fraction(row.scaled_s), row.row_fraction,
            cdf_mass(row.units, column.units())};
  }
  const TexelPositions& positions() const { return positions_; }

  PerSquare pdf(SquarePoint at) const {
    const int y = cell_of(at.t, table_.extent().height);
    return positions_.pdf(y, table_.mass(cell_of(at.s, table_.extent().width), y), at);
  }

  const CdfTable& table() const { return table_; }

  /// What the sampler keeps, if its finder shows what it keeps.
  auto view() const requires requires(const Finder& finder) { finder.view(); }
  {
    return CdfInversionView<decltype(finder_.view())>{table_.view(), finder_.view(),
                                                      positions_.view()};
  }

  std::size_t table_bytes() const { return table_.bytes() + finder_.bytes() + positions_.bytes(); }

 private:
  Row row_of(SquarePoint u) const {
    const double scaled_t = below_one(u.t) * kCdfOne;
    const CdfCell row = finder_.row(table_, static_cast<std::uint32_t>(scaled_t));
    return {row.index, row.units(), row.fraction(scaled_t), below_one(u.s) * kCdfOne};
  }

  CdfTable table_;
  Finder finder_;
  TexelPositions positions_;
};

/// A search of sorted CDF entries, which needs nothing beside them.
using EntrySearch = int (*)(CdfEntries entries, std::uint32_t u);
/// The CDF entries of a table as they are, searched by kSearch.

template <EntrySearch kSearch>
class SortedEntries {
 public:
  explicit SortedEntries(const CdfTable& /*table*/) {}
  CdfCell row(const CdfTable& table, std::uint32_t u) const { return find(table.rows(), u); }
  CdfCell column(const CdfTable& table, int y, std::uint32_t u) const {
    return find(table.columns(y), u);
  }
  std::size_t bytes() const { return 0; }

 private:
  static CdfCell find(CdfEntries entries, std::uint32_t u) {
    const int index = kSearch(entries, u);
    const auto k = static_cast<std::size_t>(index);
    return {entries[k], entries[k + 1], index};
  }
};

}  // namespace lightproof
