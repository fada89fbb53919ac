// Exact integrals of a lobe over the texels around its axis, for lobes that spherical harmonics
// serve badly: narrower than a texel, or with an edge at the horizon.
#pragma once

#include <functional>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"

namespace lightproof {

/// A function of the angle to an axis, 0 beyond its support.
struct ZonalKernel {
  /// The kernel as a function of the angle's haversine, (1 - cos)/2, in which no small angle is
  /// lost.
  std::function<double(double haversine)> value;
  Radians width;          ///< over which it falls off around its axis
  Radians support;        ///< at most pi
  bool has_edge = false;  ///< it ends at its support with a jump
};

/// What the texels of a map weigh in the integral of the map times a kernel.
class TexelStencil {
 public:
  /// The stencil of a map of this size, for an axis in column 0 at s = offset/width, offset in
  /// [0,1), and at t. Cells are divided until they are a quarter of the kernel's width, or of their
  /// distance to the axis, and integrated with 3 x 3 Gauss-Legendre nodes, or with one where they
  /// are a fiftieth of it; at an edge of the kernel they are divided to 0.02 radians and cut by a
  /// straight line. The weights are scaled to the sum `whole`.
  TexelStencil(const ZonalKernel& kernel, Extent extent, SquarePoint axis, double whole);

  /// The weighted sum over a map of that size, for an axis that lies `column` columns further on.
  glm::dvec3 sum(const Grid<Rgb>& map, int column) const;

 private:
  /// Texels next to each other.
  struct Run {
    int row;
    int first;  ///< column, may be negative
    std::vector<double> weights;
  };

  std::vector<Run> runs_;
};

/// The sums at the texel centres of a grid; the kernel's integral is taken to be `whole`.
Grid<glm::dvec3> local_sums(const Grid<Rgb>& map, const ZonalKernel& kernel, double whole,
                            Extent extent);

/// The sum of local_sums() at one direction.
glm::dvec3 local_sum(const Grid<Rgb>& map, const ZonalKernel& kernel, double whole, Direction axis);

}  // namespace lightproof
