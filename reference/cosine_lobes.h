// Distributions over directions that are mixtures of powers of cosines: the hemisphere's
// warps, and what Phong's materials draw.
#pragma once

#include <span>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "reference/rosenblatt_transform.h"

namespace lightproof::reference {

/// Density share (n+1)/2pi (axis.d)^n on the side of the axis, 0 beyond (Lewis 1994). n = 0 is
/// uniform over the hemisphere, n = 1 the cosine's own.
struct CosineLobe {
  Direction axis;   ///< unit vector
  double exponent;  ///< n >= 0
  double share;     ///< probability of the lobe; the shares of a mixture sum to 1
};

/// Density of the mixture at a direction, per steradian.
double density(std::span<const CosineLobe> lobes, Direction d);

/// A grid over the square whose cells are small against the narrowest lobe.
Extent cells_for(std::span<const CosineLobe> lobes);

/// Probabilities of the cells of a grid over the square; they sum to 1. Lobes around +z in closed
/// form, their cumulative distribution being cos^(n+1); others by quadrature.
Grid<double> cell_masses(std::span<const CosineLobe> lobes, Extent cells);

/// Whether every lobe stands on +z.
bool is_around_z(std::span<const CosineLobe> lobes);

/// The Rosenblatt transform of a mixture of lobes around +z at a point of the square.
RosenblattPoint rosenblatt_point(std::span<const CosineLobe> lobes, SquarePoint at);

}  // namespace lightproof::reference
