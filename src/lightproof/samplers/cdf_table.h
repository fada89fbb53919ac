// The cumulative distributions of all rows and of the columns in each row, in fixed point.
//
// CDF entries are integers in units of 2^-31. Compared with 32-bit floats of the same size their
// step is the same everywhere (a float's is 2^-25 below 1), differences are exact, so the pdf that
// is returned is the density that is drawn, and they compare with the random number's integer bits.
// Compared with doubles they take half the memory. A texel of positive weight always keeps at
// least one unit: f > 0 implies p > 0.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/core/huge_pages.h"
#include "lightproof/image/target_density.h"

namespace lightproof {

/// The CDF entries of a distribution, in units of 2^-31: entries[k] is the mass before cell k, and
/// the last one is kCdfOne.
using CdfEntries = std::span<const std::uint32_t>;
/// The probability 1 in units of CDF entries.
inline constexpr std::uint32_t kCdfOne = 1U << 31U;

/// Probability of a texel, from that of its row and of its column in the row in units of 2^-31.
inline double cdf_mass(double row, double column) { return 0x1p-62 * row * column; }

/// Writes the weights.size() + 1 CDF entries of at most 2^18 weights; the last entry is `one`,
/// which is more than there are weights. All are zero if every weight is zero. Returns the sum of
/// the weights.
double quantise_cdf(std::span<const double> weights, std::span<std::uint32_t> entries,
                    std::uint32_t one = kCdfOne);

/// The CDF entries of a distribution over a grid: of the marginal over rows, and of the conditional
/// over columns in each row.
class CdfTable {
 public:
  /// The distribution of texels of a map's target density. Throws InputError if the map is black.
  CdfTable(const EnvironmentMap& map, TargetDensity target);
  /// The distribution of any cells in proportion to weights, one of which is positive.
  explicit CdfTable(const Grid<double>& weights);

  Extent extent() const { return extent_; }
  /// CDF entries of the rows.
  CdfEntries rows() const { return CdfEntries(rows_).first(entries_of(extent_.height)); }
  /// CDF entries of the columns in row y.
  CdfEntries columns(int y) const {
    const std::size_t stride = entries_of(extent_.width);
    return {columns_.data() + static_cast<std::size_t>(y) * stride, stride};
  }
  /// Probability with which cell (x, y) is drawn.
  double mass(int x, int y) const { return cdf_mass(units(rows(), y), units(columns(y), x)); }
  struct View {
    const std::uint32_t* rows;
    const std::uint32_t* columns;
    std::size_t stride;  ///< CDF entries of a row

    const std::uint32_t* row(std::size_t y) const { return columns + y * stride; }
  };
  View view() const { return {rows_.data(), columns_.data(), entries_of(extent_.width)}; }

  /// Numbers behind the last CDF entry of all rows, and of all columns, that may be read.
  static constexpr std::size_t kEntriesAfter = 2;

  std::size_t bytes() const { return (rows_.size() + columns_.size()) * sizeof(std::uint32_t); }

 private:
  template <class Weigh>
  void fill(const Weigh& weigh);

  static std::size_t entries_of(int cells) { return static_cast<std::size_t>(cells) + 1; }
  /// Mass of a cell in units of 2^-31.
  static double units(CdfEntries entries, int cell) {
    const auto k = static_cast<std::size_t>(cell);
    return static_cast<double>(entries[k + 1] - entries[k]);
  }

  Extent extent_;
  std::vector<std::uint32_t> rows_;
  TableVector<std::uint32_t> columns_;
};

}  // namespace lightproof
