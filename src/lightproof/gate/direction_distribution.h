// What a sampler of directions claims to draw, and how the gate tests it: as a distribution over
// the unit square, like that of a sampler of maps.
//
// A sum of cosine lobes lies on the square of latitude and longitude, whose cells must be small
// against the lobes. A lobe of any shape and width lies on a square of its own coordinates, in
// which it is uniform: those of a reference::UniformChart.
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include "lightproof/gate/expectation.h"
#include "lightproof/gate/test_case.h"
#include "reference/cosine_lobes.h"
#include "reference/uniform_chart.h"

namespace lightproof {

/// Cosine lobes that a distribution over directions is the sum of; their shares sum to 1.
using CosineLobes = std::vector<reference::CosineLobe>;

/// A density over directions that could be drawn by mistake.
struct MistakenDensity {
  std::string_view name;       ///< "alpha-squared"
  std::string_view diagnosis;  ///< what it looks like, as a clause
  /// A function of direction to which it is proportional.
  std::function<double(Direction)> density;
};

/// A density in coordinates in which it is uniform. Its means and variances are those of estimators
/// over the square, taken for a latitude-longitude map of constant radiance under density A.
struct ChartedDensity {
  reference::UniformChart chart;
  std::vector<MistakenDensity> mistakes;
};

using DirectionDistribution = std::variant<CosineLobes, ChartedDensity>;

/// A direction and the density with which it was drawn.
struct DrawnDirection {
  Direction direction;
  PerSteradian pdf;
};

/// The cells of the square over which samples are counted.
Extent cells_of(const CosineLobes& lobes);
Extent cells_of(const ChartedDensity& density);

/// The direction at a point of the square, and the solid angle per area of the square there.
struct PlacedDirection {
  Direction direction;
  double solid_angle_per_area;
};
PlacedDirection direction_at(const CosineLobes& lobes, SquarePoint at);
PlacedDirection direction_at(const ChartedDensity& density, SquarePoint at);

/// A direction as a sample of the square, with its density there. On latitude and longitude a pole
/// is moved by less than a cell, since the square has no density there; a direction that a charted
/// density cannot give lies nowhere on the square, and its coordinates are not numbers.
TexelSample sample_of(const CosineLobes& lobes, Extent cells, const DrawnDirection& drawn);
TexelSample sample_of(const ChartedDensity& density, Extent cells, const DrawnDirection& drawn);

/// The exact side.
std::shared_ptr<const Expectation> expectation_of(const CosineLobes& lobes);
std::shared_ptr<const Expectation> expectation_of(const ChartedDensity& density);

/// What could be drawn by mistake.
std::vector<Alternative> alternatives_to(const CosineLobes& lobes);
std::vector<Alternative> alternatives_to(const ChartedDensity& density);

}  // namespace lightproof
