#include "lightproof/check/density_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "lightproof/check/compared_samples.h"
#include "lightproof/check/dump_sampler.h"
#include "lightproof/core/error.h"
#include "lightproof/warp/lat_long.h"
#include "lightproof/warp/mapping.h"

namespace lightproof {
namespace {

constexpr std::size_t kBlock = 4096;
constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// How far from the centre of its cell, in cells, a point may lie.
constexpr double kOffCentre = 0.01;
/// By how much the integral of a grid may differ from 1, relative, where no declared density says
/// how exact the grid is.
constexpr double kUndeclared = 0.01;

/// The rows of a grid of cell centres, given all t of its points; none if they are no such rows.
std::optional<int> rows_of(std::vector<double> heights) {
  std::ranges::sort(heights);
  int rows = 1;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    // No grid of so many points has rows as near to each other.
    if (heights[i] - heights[i - 1] > 0.5 / static_cast<double>(heights.size())) ++rows;
  }
  return heights.size() % static_cast<std::size_t>(rows) == 0 ? std::optional(rows) : std::nullopt;
}

bool is_centre(double coordinate, int cells) {
  const double in_cell = coordinate * cells - std::floor(coordinate * cells);
  return std::abs(in_cell - 0.5) <= kOffCentre;
}

/// Sets the cells of points that are the centres of a grid over (s,t); else says why not.
void set_cells(DensityGrid& grid) {
  grid.why_no_cells = "the points are not the centres of all cells of a grid over (s,t)";
  std::vector<double> heights;
  for (const DensityGrid::Point& point : grid.points) {
    const SquarePoint at = square_from_direction(point.given.direction);
    if (!std::isfinite(at.t)) return;
    heights.push_back(at.t);
  }
  const auto rows = rows_of(std::move(heights));
  if (!rows) return;
  const auto height = static_cast<std::size_t>(*rows);
  const Extent extent = {static_cast<int>(grid.points.size() / height), *rows};
  Grid<std::uint8_t> is_there(extent);
  for (const DensityGrid::Point& point : grid.points) {
    const SquarePoint at = square_from_direction(point.given.direction);
    if (!is_centre(at.s, extent.width) || !is_centre(at.t, extent.height)) return;
    std::uint8_t& its = is_there(cell_of(at.s, extent.width), cell_of(at.t, extent.height));
    if (std::exchange(its, std::uint8_t{1}) != 0) return;
  }
  for (DensityGrid::Point& point : grid.points) {
    const SquarePoint at = square_from_direction(point.given.direction);
    point.solid_angle = texel_solid_angle(extent, cell_of(at.t, extent.height));
  }
  grid.cells = extent;
  grid.why_no_cells.clear();
}

bool is_off(const DeclaredAtPoint& at, double tolerance) {
  if (at.declared > 0.0) return !(std::abs(at.given / at.declared - 1.0) <= tolerance);
  return at.given != 0.0;  // true for NaN
}

double error_of(const DeclaredAtPoint& at) {
  if (!(at.declared > 0.0)) return at.given == 0.0 ? 0.0 : kInfinite;
  return std::abs(at.given / at.declared - 1.0);
}

TestRecord compared(const DensityGrid& grid, const DeclaredDensity& declared, double tolerance,
                    TestRecord record) {
  record.test = TestId::grid_density;
  record.samples = grid.points.size();
  std::size_t off = 0;
  for (const DensityGrid::Point& point : grid.points) {
    if (!std::isfinite(point.given.direction.x)) {
      if (off++ == 0) record.detail = "a row is no direction";
      record.effect = kInfinite;
      continue;
    }
    const DeclaredAtPoint at = declared(point.given, grid.rounding);
    const double error = error_of(at);
    const bool is_worse = !(error <= record.effect);
    if (is_worse) record.effect = std::isnan(error) ? kInfinite : error;
    if (!is_off(at, tolerance)) continue;
    ++off;
    if (!is_worse && off > 1) continue;
    const Direction d = point.given.direction;
    record.detail =
        fmt::format("the worst towards ({:.4g}, {:.4g}, {:.4g}): {:.6g} times the declared density",
                    d.x, d.y, d.z, at.given / at.declared);
  }
  record.statistic = static_cast<double>(off);
  record.outcome = off == 0 ? Outcome::accept : Outcome::reject;
  record.detail = off == 0 ? "" : fmt::format("{} points are off, {}", off, record.detail);
  return record;
}

TestRecord integrated(const DensityGrid& grid, const DeclaredDensity& declared, double tolerance,
                      TestRecord record) {
  record.test = TestId::grid_integral;
  record.samples = grid.points.size();
  if (!grid.why_no_cells.empty()) {
    record.outcome = Outcome::not_run;
    record.detail = grid.why_no_cells;
    return record;
  }
  double integral = 0.0;
  double of_declared = 0.0;
  for (const DensityGrid::Point& point : grid.points) {
    integral += point.given.pdf.value * point.solid_angle;
    if (!declared) continue;
    of_declared += declared(point.given, 0.0).declared * point.solid_angle;
  }
  // What the grid's own coarseness does to the integral it does to that of the declared density.
  if (declared && of_declared > 0.0) integral /= of_declared;
  record.effect = std::abs(integral - 1.0);
  record.outcome =
      record.effect <= (declared ? tolerance : kUndeclared) ? Outcome::accept : Outcome::reject;
  if (record.outcome == Outcome::reject) {
    record.detail =
        fmt::format("the densities of {} cells add up to {:.6g}", grid.points.size(), integral);
  }
  return record;
}

}  // namespace

DensityGrid density_grid_of(const SampleDump& table) {
  if (!table.has_pdf()) throw InputError("a table of densities needs a column pdf");
  DensityGrid grid;
  grid.rounding = table.rounding();
  std::vector<DumpedSample> block(kBlock);
  for (std::uint64_t first = 0; first < table.count(); first += kBlock) {
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, table.count() - first));
    table.read(first, std::span(block).first(count));
    for (std::size_t i = 0; i < count; ++i) grid.points.push_back({block[i]});
  }
  set_cells(grid);
  return grid;
}

DensityGrid density_grid_of(const EnvironmentMap& picture, DensityMeasure measure) {
  const Extent extent = picture.radiance.extent();
  DensityGrid grid;
  grid.rounding = 0x1p-50;
  grid.cells = extent;
  grid.mapping = picture.mapping;
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const SquarePoint at = {(x + 0.5) / extent.width, (y + 0.5) / extent.height};
      const double density = luminance_of(picture.radiance(x, y), kRec709);
      const double per = measure == DensityMeasure::solid_angle
                             ? 1.0
                             : solid_angle_per_square(picture.mapping, at);
      grid.points.push_back({{direction_at(picture.mapping, at), {density / per}},
                             texel_solid_angle(picture.mapping, extent, x, y)});
    }
  }
  return grid;
}

DeclaredDensity declared_density_of(std::shared_ptr<const Expectation> expectation) {
  return [expectation = std::move(expectation)](const DumpedSample& point, double rounding) {
    const ComparedCell cell = compared_at(point, *expectation, rounding);
    const double jacobian = solid_angle_per_square(expectation->mapping, cell.at);
    // At a pole a density over the square says nothing of one over directions.
    if (!(jacobian > 0.0)) return DeclaredAtPoint{};
    return DeclaredAtPoint{cell.pdf / jacobian, cell.declared / jacobian};
  };
}

DeclaredDensity declared_density_of(const DirectionTarget& target) {
  return [target](const DumpedSample& point, double rounding) {
    const double given = point.pdf.value;
    double least = density_of(target.distribution, point.direction);
    double most = least;
    if (given == least) return DeclaredAtPoint{given, given};
    visit_around(point.direction, rounding, [&](Direction turned) {
      const double declared = density_of(target.distribution, turned);
      least = std::min(least, declared);
      most = std::max(most, declared);
    });
    return DeclaredAtPoint{given, std::clamp(std::isnan(given) ? most : given, least, most)};
  };
}

std::vector<TestRecord> judge_density_grid(const DensityGrid& grid, const DeclaredDensity& declared,
                                           double tolerance, const TestRecord& record) {
  std::vector<TestRecord> records;
  if (declared) records.push_back(compared(grid, declared, tolerance, record));
  records.push_back(integrated(grid, declared, tolerance, record));
  return records;
}

}  // namespace lightproof
