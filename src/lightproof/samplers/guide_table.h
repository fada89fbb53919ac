// Inversion through a guide table (Chen and Asau 1974, "On generating random variates from an
// empirical distribution"): the first bits of the random number name a cell to begin with, and
// bisection of the knots up to the next one's cell finds the right one. On average O(1) per sample,
// never worse than O(log W + log H): a scan inside a guide's cell would be, under a sun. Texel for
// texel the same as LinearScan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lightproof/samplers/cdf_inversion.h"

namespace lightproof {

/// For each of several distributions of the same number of cells, at most 65536: the cell that
/// every 2^bits-th part of [0,1) begins in.
class Guides {
 public:
  Guides(std::size_t count, std::size_t cells);
  void set(std::size_t guide, CdfKnots knots);
  /// Of the distribution that was set with these knots.
  CdfCell find(std::size_t guide, CdfKnots knots, std::uint32_t u) const {
    const std::size_t part = guide * parts_ + (u >> shift_);
    std::size_t cell = first_[part];
    for (std::size_t cells = first_[part + 1] - cell + std::size_t{1}; cells > 1;) {
      const std::size_t half = cells / 2;
      cell += knots[cell + half] <= u ? half : 0;
      cells -= half;
    }
    return {static_cast<int>(cell), knots[cell], knots[cell + 1]};
  }
  std::size_t bytes() const { return first_.size() * sizeof(std::uint16_t); }

 private:
  unsigned shift_;
  std::size_t parts_;  ///< of one guide, and its end
  std::vector<std::uint16_t> first_;
};

class GuidedKnots {
 public:
  explicit GuidedKnots(const CdfTable& table);
  CdfCell row(const CdfTable& table, std::uint32_t u) const {
    return rows_.find(0, table.rows(), u);
  }
  CdfCell column(const CdfTable& table, int y, std::uint32_t u) const {
    return columns_.find(static_cast<std::size_t>(y), table.columns(y), u);
  }
  std::size_t bytes() const { return rows_.bytes() + columns_.bytes(); }

 private:
  Guides rows_;
  Guides columns_;
};

using GuideTable = CdfInversion<GuidedKnots>;
static_assert(EnvSampler<GuideTable>);

}  // namespace lightproof
