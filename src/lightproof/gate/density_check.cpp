#include "lightproof/gate/density_check.h"

#include <algorithm>
#include <vector>

#include "lightproof/gate/sampler_rows.h"
#include "lightproof/samplers/cdf_lines.h"
#include "lightproof/warp/lat_long.h"
#include "lightproof/warp/mapping.h"

namespace lightproof {
namespace {

/// How far a pdf may be off that claims the declared density exactly: the rounding of floats, as of
/// returned pdfs.
constexpr double kRelative = 1e-5;
/// Below this a density is 0 for one formula and a denormal number for another.
constexpr double kNoDensity = 1e-290;

/// Where the cells of a row lie, and what is around them.
struct Row {
  const Expectation* expectation;
  Extent cells;
  int y;  ///< of cells

  int texel_row() const { return y * expectation->masses.extent().height / cells.height; }
  /// The cells of the row, in their order.
  std::vector<ComparedCell> compared(const BoundSampler& sampler) const {
    const auto count = static_cast<std::size_t>(cells.width);
    std::vector<SquarePoint> positions(count);
    std::vector<PerSquare> densities(count);
    for (int x = 0; x < cells.width; ++x) {
      positions[static_cast<std::size_t>(x)] = {(x + 0.5) / cells.width, (y + 0.25) / cells.height};
    }
    sampler.pdf_at(positions, densities);
    std::vector<ComparedCell> compared(count);
    for (int x = 0; x < cells.width; ++x) {
      const auto i = static_cast<std::size_t>(x);
      ComparedCell& cell = compared[i];
      cell.x = x * expectation->masses.extent().width / cells.width;
      cell.y = texel_row();
      cell.at = positions[i];
      cell.pdf = densities[i].value;
      cell.declared = declared_density(*expectation, cell.at, cell.x, cell.y);
    }
    return compared;
  }
  /// Probability of the row of texels, or of the bilinear patches whose lower half, but for the
  /// first row, begins with an odd row of cells.
  double mass() const {
    const std::vector<double>& rows = expectation->smooth_rows;
    if (rows.empty()) return expectation->rows[static_cast<std::size_t>(y)];
    const bool patches = expectation->lookup == Lookup::bilinear;
    return rows[static_cast<std::size_t>(patches ? (y + 1) / 2 : y)];
  }
  /// Probability of every run of the texels' row.
  std::vector<double> runs() const {
    std::vector<double> masses;
    const auto row = expectation->masses.row(texel_row());
    for (std::size_t x = 0; x < row.size(); ++x) {
      if (x % kRunTexels == 0) masses.push_back(0.0);
      masses.back() += row[x];
    }
    return masses;
  }
};

MapMeasure other_measure(const Expectation& expectation) {
  return expectation.positions() == MapMeasure::square ? MapMeasure::solid_angle
                                                       : MapMeasure::square;
}

/// The density over the square, at a point of a texel of row y, of this mass in the texel.
double spread(double mass, MapMeasure measure, Extent extent, SquarePoint at, int y) {
  if (measure == MapMeasure::square) return mass * static_cast<double>(extent.count());
  return to_square(PerSteradian{mass / texel_solid_angle(extent, y)}, at).value;
}

/// What one row of cells says; rows are put together in their order.
struct RowComparison {
  DensityComparison found;
  double excess = 0.0;  ///< error of the worst cell over its bound

  /// A cell of this probability, whose error in probability may be as large as the bound.
  void add(const ComparedCell& cell, double mass, double bound, const Mapping& mapping) {
    if (!(cell.declared > kNoDensity)) {
      if (std::abs(cell.pdf) <= kNoDensity) return;  // false for NaN
      if (found.unlit_cells++ == 0) found.first_unlit = cell;
      return;
    }
    const double ratio = found.add_ratio(cell, mapping);
    if (cell.pdf <= 0.0) {
      found.unreachable_mass += mass;
      if (found.unreachable_cells++ == 0) found.first_unreachable = cell;
    } else {
      const double weight_error = std::abs(1.0 / ratio - 1.0);
      found.largest_weight_error = std::max(found.largest_weight_error, weight_error);
      found.rounding_variance += weight_error * weight_error * ratio * mass;
    }
    const double over = std::abs(ratio - 1.0) * mass / bound;
    if (over <= 1.0) return;  // false for NaN
    ++found.cells_off;
    if (cell.pdf <= 0.0 && found.undeclared_unreachable_cells++ == 0)
      found.first_undeclared_unreachable = cell;
    if (found.worst && over <= excess) return;
    excess = over;
    found.worst = cell;
  }
};

RowComparison compare_row(const Row& row, const BoundSampler& sampler,
                          const MassRounding& rounding) {
  const Expectation& expectation = *row.expectation;
  const double area = 1.0 / static_cast<double>(row.cells.count());
  const std::vector<double> runs = row.runs();
  const double row_mass = row.mass();
  RowComparison result;
  for (const ComparedCell& cell : row.compared(sampler)) {
    // A cell of a texel is all of it, whatever the density does inside.
    const double mass =
        expectation.density ? cell.declared * area : expectation.masses(cell.x, cell.y);
    const double run = runs[static_cast<std::size_t>(cell.x / kRunTexels)];
    const double bound = kRelative * mass +
                         rounding.bound({mass, run, row_mass, expectation.masses.extent().count()});
    result.add(cell, mass, bound, expectation.mapping);
    if (!expectation.density && mass > 0.0 && has_two_measures(expectation.mapping)) {
      const double other =
          spread(mass, other_measure(expectation), expectation.masses.extent(), cell.at, cell.y);
      result.found.over_other_measure.add(cell.pdf / other);
    }
  }
  return result;
}

void merge(DensityComparison& all, double& excess, const RowComparison& row) {
  const DensityComparison& found = row.found;
  if (!all.first_unreachable) all.first_unreachable = found.first_unreachable;
  if (!all.first_unlit) all.first_unlit = found.first_unlit;
  if (!all.first_undeclared_unreachable)
    all.first_undeclared_unreachable = found.first_undeclared_unreachable;
  all.unreachable_cells += found.unreachable_cells;
  all.unreachable_mass += found.unreachable_mass;
  all.undeclared_unreachable_cells += found.undeclared_unreachable_cells;
  all.unlit_cells += found.unlit_cells;
  all.largest_error = std::max(all.largest_error, found.largest_error);
  all.rounding_variance += found.rounding_variance;
  all.largest_weight_error = std::max(all.largest_weight_error, found.largest_weight_error);
  all.ratio.merge(found.ratio);
  all.times_jacobian.merge(found.times_jacobian);
  all.over_jacobian.merge(found.over_jacobian);
  all.over_other_measure.merge(found.over_other_measure);
  all.cells_off += found.cells_off;
  if (found.worst && (!all.worst || row.excess > excess)) {
    excess = row.excess;
    all.worst = found.worst;
  }
}

}  // namespace

void RatioRange::add(double ratio) { merge({ratio, ratio}); }

void RatioRange::merge(const RatioRange& other) {
  least = std::min(least, other.least);
  largest = std::max(largest, other.largest);
}

bool RatioRange::is_constant() const { return least > 0.0 && largest <= least * (1.0 + kRelative); }

double DensityComparison::add_ratio(const ComparedCell& cell, const Mapping& mapping) {
  const double of_both = cell.pdf / cell.declared;
  const double jacobian = solid_angle_per_square(mapping, cell.at);
  ratio.add(of_both);
  times_jacobian.add(of_both * jacobian);
  over_jacobian.add(of_both / jacobian);
  // A cell that cannot be reached is counted as such, and not as one that is off by all of it.
  if (of_both > 0.0) largest_error = std::max(largest_error, std::abs(of_both - 1.0));
  return of_both;
}

double declared_density(const Expectation& expectation, SquarePoint at, int x, int y) {
  if (expectation.density) return expectation.density(at);
  return spread(expectation.masses(x, y), expectation.positions(), expectation.masses.extent(), at,
                y);
}

DensityComparison compare_density(const BoundSampler& sampler, const Expectation& expectation,
                                  const MassRounding& rounding) {
  const Extent cells = expectation.smooth_cells();
  std::vector<RowComparison> rows(static_cast<std::size_t>(cells.height));
  const auto compare = [&](std::size_t y) {
    rows[y] = compare_row({&expectation, cells, static_cast<int>(y)}, sampler, rounding);
  };
  for_rows(rows.size(), compare);
  DensityComparison all;
  double excess = 0.0;
  for (const RowComparison& row : rows) merge(all, excess, row);
  return all;
}

}  // namespace lightproof
