#include "lightproof/check/grid_histogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lightproof/check/compared_samples.h"
#include "lightproof/gate/expectation.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/stats/goodness_of_fit.h"
#include "lightproof/warp/mapping.h"

namespace lightproof {
namespace {

/// By how much probabilities by a grid may be off at the least, relative.
constexpr double kInexact = 0.01;
/// A block whose probability is known less exactly, relative, is not known.
constexpr double kKnown = 1.0 / 3.0;
/// Keeps a block whose probability is 0 among the cells of the test.
constexpr double kSmallest = 1e-300;

double half_second_difference(double before, double here, double after) {
  return 0.5 * std::abs(before - 2.0 * here + after);
}

/// Half of the second differences of a density in both directions, on latitude and longitude around
/// the seam and across the poles.
double half_differences_on_sphere(const Grid<double>& densities, int x, int y) {
  const auto [width, height] = densities.extent();
  const double here = densities(x, y);
  const double across = densities((x + width / 2) % width, y);
  return half_second_difference(densities((x + width - 1) % width, y), here,
                                densities((x + 1) % width, y)) +
         half_second_difference(y == 0 ? across : densities(x, y - 1), here,
                                y == height - 1 ? across : densities(x, y + 1));
}

/// Half of the second differences of a density on a square whose edges meet elsewhere: a cell
/// beside an edge may be off by all of its density.
double half_differences_on_square(const Grid<double>& densities, int x, int y) {
  const auto [width, height] = densities.extent();
  const double here = densities(x, y);
  if (x == 0 || y == 0 || x == width - 1 || y == height - 1) return here;
  return half_second_difference(densities(x - 1, y), here, densities(x + 1, y)) +
         half_second_difference(densities(x, y - 1), here, densities(x, y + 1));
}

/// What the grid says of blocks of its cells.
struct GridBlocks {
  Extent extent;
  std::vector<double> probability;
  std::vector<double> inexact;  ///< by how much each may be off

  std::size_t of_cell(Extent cells, int x, int y) const {
    const auto column = static_cast<std::size_t>(x * extent.width / cells.width);
    const auto row = static_cast<std::size_t>(y * extent.height / cells.height);
    return row * static_cast<std::size_t>(extent.width) + column;
  }
  /// The share of the probability of those blocks of which it is known.
  double known() const {
    double sum = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < probability.size(); ++i) {
      all += probability[i];
      if (inexact[i] <= kKnown * probability[i]) sum += probability[i];
    }
    return sum / all;
  }
};

GridBlocks grid_blocks_of(const DensityGrid& grid) {
  const Extent cells = grid.cells;
  Grid<double> densities(cells);
  Grid<double> solid_angles(cells);
  for (const DensityGrid::Point& point : grid.points) {
    const SquarePoint at = square_point_of(grid.mapping, point.given.direction);
    const int x = cell_of(at.s, cells.width);
    const int y = cell_of(at.t, cells.height);
    densities(x, y) = point.given.pdf.value;
    solid_angles(x, y) = point.solid_angle;
  }
  GridBlocks blocks;
  blocks.extent = {std::min(cells.width, kGateBins.width),
                   std::min(cells.height, kGateBins.height)};
  blocks.probability.resize(blocks.extent.count());
  blocks.inexact.resize(blocks.extent.count());
  const auto half_differences = grid.mapping.kind == MappingKind::lat_long
                                    ? half_differences_on_sphere
                                    : half_differences_on_square;
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      const double solid_angle = solid_angles(x, y);
      const std::size_t block = blocks.of_cell(cells, x, y);
      blocks.probability[block] += densities(x, y) * solid_angle;
      blocks.inexact[block] +=
          (kInexact * densities(x, y) + half_differences(densities, x, y)) * solid_angle;
    }
  }
  return blocks;
}

struct BlockCounts {
  std::vector<std::uint64_t> of_blocks;
  std::uint64_t samples = 0;
};

BlockCounts counted_in_blocks(const DensityGrid& grid, const GridBlocks& blocks,
                              const SampleDump& dump) {
  BlockCounts counts{std::vector<std::uint64_t>(blocks.probability.size()), 0};
  std::vector<DumpedSample> samples(kSampleBlock);
  for (std::uint64_t first = 0; first < dump.count(); first += kSampleBlock) {
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(kSampleBlock, dump.count() - first));
    dump.read(first, std::span(samples).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      if (!std::isfinite(samples[i].direction.x)) continue;
      const SquarePoint at = square_point_of(grid.mapping, samples[i].direction);
      const int x = cell_of(at.s, grid.cells.width);
      const int y = cell_of(at.t, grid.cells.height);
      ++counts.of_blocks[blocks.of_cell(grid.cells, x, y)];
      ++counts.samples;
    }
  }
  return counts;
}

/// Why the densities give no probabilities; empty if they do.
std::string why_no_probabilities(const DensityGrid& grid) {
  if (!grid.why_no_cells.empty()) return grid.why_no_cells;
  double integral = 0.0;
  for (const DensityGrid::Point& point : grid.points) {
    if (!(point.given.pdf.value >= 0.0)) return "a density of the grid is negative or no number";
    integral += point.given.pdf.value * point.solid_angle;
  }
  if (std::isfinite(integral) && integral > 0.0) return "";
  return fmt::format("the densities of the grid add up to {:.3g}", integral);
}

}  // namespace

TestRecord judge_grid_histogram(const DensityGrid& grid, const SampleDump& dump, double alpha,
                                TestRecord record) {
  record.test = TestId::grid_bins;
  record.samples = dump.count();
  record.outcome = Outcome::not_run;
  record.detail = why_no_probabilities(grid);
  if (!record.detail.empty()) return record;
  const GridBlocks blocks = grid_blocks_of(grid);
  if (!(blocks.known() > 0.5)) {
    record.detail =
        "the densities change too fast from cell to cell to say what lies in a block of cells: a "
        "finer grid would";
    return record;
  }
  const BlockCounts counts = counted_in_blocks(grid, blocks, dump);
  if (counts.samples == 0) {
    record.detail = "no row is a direction";
    return record;
  }
  record.samples = counts.samples;
  const auto n = static_cast<double>(counts.samples);
  // Rounding puts samples of one cell into the next.
  const double rounding =
      (dump.rounding() + grid.rounding) * (grid.cells.width + grid.cells.height);
  std::vector<double> nearest(blocks.probability.size());
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const double inexact = blocks.inexact[i] + rounding;
    nearest[i] = std::max(
        kSmallest, std::clamp(static_cast<double>(counts.of_blocks[i]) / n,
                              blocks.probability[i] - inexact, blocks.probability[i] + inexact));
  }
  const WorstCell worst = worst_cell(counts.of_blocks, nearest, counts.samples);
  record.statistic = worst.observed;
  record.log10_p = worst.log10_p;
  record.effect = worst.observed / worst.expected - 1.0;
  record.outcome = *record.log10_p <= std::log10(alpha) ? Outcome::reject : Outcome::accept;
  record.detail = "";
  if (record.outcome == Outcome::reject) {
    const auto width = static_cast<std::size_t>(blocks.extent.width);
    record.detail = fmt::format(
        "block {}, {} of {} x {}, from the left and the bottom: {} samples where the densities say "
        "{:.5g} at the {}",
        worst.cell % width, worst.cell / width, blocks.extent.width, blocks.extent.height,
        worst.observed, worst.expected, worst.observed > worst.expected ? "most" : "least");
  }
  return record;
}

}  // namespace lightproof
