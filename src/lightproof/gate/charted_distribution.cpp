// Densities in coordinates in which they are uniform.
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "lightproof/core/gauss_rule.h"
#include "lightproof/gate/direction_distribution.h"

namespace lightproof {
namespace {

constexpr Extent kCells = {128, 64};

Grid<double> even_masses(Extent cells) {
  return Grid<double>(cells, 1.0 / static_cast<double>(cells.count()));
}

/// Moments of the estimators over the square as a map of radiance 1.
void add_estimators(Expectation& expectation) {
  const auto never = [](Direction, double) { return false; };
  const Grid<double> even(kCells, 1.0);
  const auto moments_of = [&](const reference::Kernel& kernel) {
    return reference::light_moments(kernel, {&even, 1})[0];
  };
  for (std::size_t i = 0; i < kMeanCaseCount; ++i) {
    // The horizons of both normals are edges of cells.
    const reference::Kernel cosine = reference::cosine_kernel(kMeanCases[i].normal);
    const reference::LightMoments moments = moments_of({cosine.at, never});
    expectation.estimators[i] = moments[reference::SampledDensity::texture_space];
    expectation.uniform[i] = moments[reference::SampledDensity::uniform];
  }
  const reference::Kernel one = {[](Direction) { return reference::KernelValue{1.0, 1.0}; }, never};
  expectation.inverse_pdf = moments_of(one)[reference::SampledDensity::texture_space];
}

Expectation uniform_expectation() {
  Expectation expectation;
  expectation.density_space = DensitySpace::texture;
  expectation.luminance = Grid<double>(kCells, 1.0);
  expectation.mean_luminance = 1.0;
  expectation.masses = even_masses(kCells);
  expectation.bins = even_masses(kGateBins);
  expectation.rows.assign(static_cast<std::size_t>(kCells.height), 1.0 / kCells.height);
  expectation.columns.assign(static_cast<std::size_t>(kCells.width), 1.0 / kCells.width);
  expectation.transform = [](std::span<const TexelSample> samples,
                             std::span<const double> /*cosines*/,
                             std::span<reference::RosenblattPoint> points) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      points[i] = {samples[i].at.t, samples[i].at.s, samples[i].at.s};
    }
  };
  expectation.set_flags();
  add_estimators(expectation);
  return expectation;
}

/// A point of evaluation in a cell, with the density there that the chart makes uniform.
struct ChartNode {
  Direction direction;
  double pdf;
  double weight;  ///< area of the square
};

/// The nodes of a Gauss-Legendre rule over either half of a side of a cell.
std::vector<GaussNode> nodes_of_side() {
  const GaussRule<3> rule;
  std::vector<GaussNode> nodes;
  for (const double half : {0.0, 0.5}) {
    for (const GaussNode& node : rule.nodes()) {
      nodes.push_back({half + 0.5 * node.at, 0.5 * node.weight});
    }
  }
  return nodes;
}

/// 3 x 3 Gauss-Legendre nodes in each quarter of a cell, cell by cell.
std::vector<ChartNode> nodes_of(const reference::UniformChart& chart) {
  const std::vector<GaussNode> side = nodes_of_side();
  const double area = 1.0 / static_cast<double>(kCells.count());
  std::vector<ChartNode> nodes;
  const auto add_cell = [&](int x, int y) {
    for (const GaussNode& in_t : side) {
      for (const GaussNode& in_s : side) {
        const SquarePoint at = {(x + in_s.at) / kCells.width, (y + in_t.at) / kCells.height};
        const Direction d = chart.direction_from_square(at);
        nodes.push_back({d, chart.pdf(d).value, area * in_t.weight * in_s.weight});
      }
    }
  };
  for (int y = 0; y < kCells.height; ++y) {
    for (int x = 0; x < kCells.width; ++x) add_cell(x, y);
  }
  return nodes;
}

/// The masses of the part of a density that lies on the square; they sum to 1.
Grid<double> masses_of(const std::function<double(Direction)>& density,
                       std::span<const ChartNode> nodes) {
  Grid<double> masses(kCells);
  const std::size_t of_cell = nodes.size() / kCells.count();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const ChartNode& node = nodes[i];
    masses.values()[i / of_cell] += node.weight * density(node.direction) / node.pdf;
  }
  const double total = std::accumulate(masses.values().begin(), masses.values().end(), 0.0);
  for (double& mass : masses.values()) mass /= total;
  return masses;
}

}  // namespace

Extent cells_of(const ChartedDensity& /*density*/) { return kCells; }

PlacedDirection direction_at(const ChartedDensity& density, SquarePoint at) {
  const Direction direction = density.chart.direction_from_square(at);
  return {direction, 1.0 / density.chart.pdf(direction).value};
}

TexelSample sample_of(const ChartedDensity& density, Extent cells, const DrawnDirection& drawn) {
  const auto at = density.chart.square_from_direction(drawn.direction);
  if (!at) {
    constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
    return {{kNowhere, kNowhere}, -1, -1, {0.0}};
  }
  return {*at,
          cell_of(at->s, cells.width),
          cell_of(at->t, cells.height),
          {drawn.pdf.value / density.chart.pdf(drawn.direction).value}};
}

std::shared_ptr<const Expectation> expectation_of(const ChartedDensity& /*density*/) {
  static const auto expectation = std::make_shared<const Expectation>(uniform_expectation());
  return expectation;
}

std::vector<Alternative> alternatives_to(const ChartedDensity& density) {
  const auto nodes = std::make_shared<const std::vector<ChartNode>>(nodes_of(density.chart));
  std::vector<Alternative> alternatives;
  for (const MistakenDensity& mistake : density.mistakes) {
    alternatives.push_back({mistake.name, mistake.diagnosis,
                            [nodes, other = mistake.density] { return masses_of(other, *nodes); }});
  }
  return alternatives;
}

}  // namespace lightproof
