#include "lightproof/gate/single_texel_defects.h"

#include <cmath>

#include "lightproof/gate/distribution_fit.h"
#include "lightproof/stats/goodness_of_fit.h"

namespace lightproof {
namespace {

/// Counts of texels and their probabilities, some texels being left out of both.
class RemainingTexels {
 public:
  RemainingTexels(const Expectation& expectation, const Draws& draws)
      : counts_(draws.texels),
        masses_(expectation.masses),
        samples_(draws.samples - draws.out_of_domain.count) {}

  WorstCell worst() const { return worst_cell(counts_.values(), masses_.values(), samples_); }

  /// Leaves a texel out; false, and nothing is left out, if no other texel has light.
  bool leave_out(std::size_t texel) {
    const double left = 1.0 - masses_.values()[texel];
    if (!(left > 0.0)) return false;
    samples_ -= counts_.values()[texel];
    counts_.values()[texel] = 0;
    masses_.values()[texel] = 0.0;
    for (double& mass : masses_.values()) mass /= left;
    return true;
  }

  /// Whether counts of texels, rows and columns fit.
  bool fit() const {
    return log10_fit_of_counts(counts_, masses_, samples_) >= std::log10(kFitLevel);
  }

 private:
  Grid<std::uint64_t> counts_;
  Grid<double> masses_;
  std::uint64_t samples_;
};

}  // namespace

bool is_in_one_texel(const Expectation& expectation, const Draws& draws) {
  // The level at which a texel is known to be off: that of a whole run.
  constexpr double kKnown = 1e-6;
  RemainingTexels texels(expectation, draws);
  for (int i = 0; i < 2; ++i) {
    const WorstCell worst = texels.worst();
    if (worst.cells < 3) return false;
    if (i == 0 && worst.log10_p > std::log10(kKnown)) return false;
    if (!texels.leave_out(worst.cell)) return false;
  }
  return texels.fit();
}

bool is_one_texel_missing(const Expectation& expectation, const Draws& draws,
                          const DensityComparison& density) {
  if (density.undeclared_unreachable_cells != 1 || expectation.lookup != Lookup::nearest)
    return false;
  const ComparedCell& cell = *density.first_undeclared_unreachable;
  const double expected = static_cast<double>(draws.samples) * expectation.masses(cell.x, cell.y);
  if (draws.texels(cell.x, cell.y) > 0 || std::exp(-expected) > kFitLevel) return false;
  RemainingTexels texels(expectation, draws);
  const auto width = static_cast<std::size_t>(expectation.masses.extent().width);
  const auto texel = static_cast<std::size_t>(cell.y) * width + static_cast<std::size_t>(cell.x);
  return texels.leave_out(texel) && texels.fit();
}

}  // namespace lightproof
