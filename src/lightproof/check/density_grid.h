// Densities on a grid of directions, as another program's pdf() has them: against the declared
// density point by point, and integrated.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lightproof/check/direction_target.h"
#include "lightproof/dump/sample_dump.h"
#include "lightproof/gate/expectation.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/results/test_record.h"

namespace lightproof {

/// Directions with densities per steradian.
struct DensityGrid {
  struct Point {
    DumpedSample given;
    double solid_angle = 0.0;  ///< of its cell, in steradian; 0 if the points are no grid of cells
  };
  std::vector<Point> points;
  double rounding = 0.0;  ///< of directions, in radians
  /// Empty if the cells tile the sphere; else why the densities cannot be integrated.
  std::string why_no_cells;
  Extent cells = {};     ///< over the square of `mapping`, if they tile the sphere
  Mapping mapping = {};  ///< how that square lies on the sphere
};

/// The rows of a table. Its cells are those of a grid over (s,t) of Lightproof's own frame, if the
/// points are the centres of all of them, in any order. Throws InputError if the rows have no
/// densities.
DensityGrid density_grid_of(const SampleDump& table);

/// The texels of a picture of densities, which are per `measure` of the picture's own mapping.
DensityGrid density_grid_of(const EnvironmentMap& picture, DensityMeasure measure);

/// The given density of a point of a grid and the declared one, that nearest to it within the
/// rounding of its direction; both per steradian. Both 0 where there is nothing to compare.
struct DeclaredAtPoint {
  double given = 0.0;
  double declared = 0.0;
};
using DeclaredDensity = std::function<DeclaredAtPoint(const DumpedSample& point, double rounding)>;

/// The density of a target on a map, by its exact side.
DeclaredDensity declared_density_of(std::shared_ptr<const Expectation> expectation);
/// The density of a distribution over directions.
DeclaredDensity declared_density_of(const DirectionTarget& target);

/// The records of a grid: the point by point comparison, with a relative tolerance, and the
/// integral, in units of that of the declared density on the same grid, with the same one. Without
/// a declared density (null) the integral alone, to one percent. `record` has what all records of
/// the run share.
std::vector<TestRecord> judge_density_grid(const DensityGrid& grid, const DeclaredDensity& declared,
                                           double tolerance, const TestRecord& record);

}  // namespace lightproof
