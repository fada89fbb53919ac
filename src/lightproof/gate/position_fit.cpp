#include "lightproof/gate/position_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "lightproof/core/measure.h"
#include "lightproof/gate/density_check.h"
#include "lightproof/gate/distribution_fit.h"
#include "lightproof/gate/row_bands.h"
#include "lightproof/stats/goodness_of_fit.h"

namespace lightproof {
namespace {

/// The rows of a map, and the measure in which shares of them are declared.
struct Rows {
  int height;
  MapMeasure declared;

  /// The share of row y by the other measure below which lies this share by the declared one.
  double by_other_measure(int y, double share) const {
    const double low = cos_theta(static_cast<double>(y) / height);
    const double high = cos_theta((y + 1.0) / height);
    if (declared == MapMeasure::square) {
      return (cos_theta((y + share) / height) - low) / (high - low);
    }
    const double cosine = std::clamp(low + share * (high - low), -1.0, 1.0);
    return std::clamp(std::acos(-cosine) / kPi * height - y, 0.0, 1.0);
  }
};

/// Probabilities of kPositionCells in a band of rows, of positions by the other measure.
std::vector<double> cells_by_other_measure(const Expectation& expectation, const RowBand& band) {
  const Rows rows = {expectation.masses.extent().height, expectation.positions()};
  std::vector<double> cells;
  for (int j = 0; j < kPositionCells.height; ++j) {
    const double from = static_cast<double>(j) / kPositionCells.height;
    const double to = (j + 1.0) / kPositionCells.height;
    double share = 0.0;
    for (int y = band.first; y <= band.last; ++y) {
      share += expectation.smooth_rows[static_cast<std::size_t>(y)] *
               (rows.by_other_measure(y, to) - rows.by_other_measure(y, from));
    }
    cells.insert(cells.end(), static_cast<std::size_t>(kPositionCells.width),
                 share / band.mass / kPositionCells.width);
  }
  return cells;
}

}  // namespace

bool PositionFit::named() const {
  return log10_odds >= std::log10(kNamingOdds) && log10_p >= std::log10(kFitLevel);
}

PositionFit fit_of_other_measure(const Expectation& expectation, const Draws& draws) {
  PositionFit fit;
  const bool of_texels = expectation.lookup == Lookup::nearest && !expectation.density &&
                         has_two_measures(expectation.mapping);
  if (!of_texels) return fit;
  for (std::size_t b = 0; b < expectation.bands.size(); ++b) {
    const RowBand& band = expectation.bands[b];
    if (!(band.mass > 0.0)) continue;
    const auto counts = draws.positions.row(static_cast<int>(b));
    const std::vector<double> cells = cells_by_other_measure(expectation, band);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const double ratio = cells[i] * static_cast<double>(kPositionCells.count());
      fit.log10_odds += static_cast<double>(counts[i]) * std::log10(ratio);
    }
    const std::uint64_t count = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    fit.log10_p = std::min(fit.log10_p, cressie_read(counts, cells, count).log10_p);
  }
  const auto bands = static_cast<double>(std::max(expectation.bands.size(), std::size_t{1}));
  fit.log10_p = std::min(0.0, fit.log10_p + std::log10(bands));
  return fit;
}

}  // namespace lightproof
