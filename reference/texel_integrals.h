// Integrals of a density over the texels of a map, by dividing texels until they are small: the
// oracle for everything that is prefiltered. It knows densities as functions of directions and
// nothing else.
#pragma once

#include <functional>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"

namespace lightproof::reference {

/// A density over directions, 0 below the horizon of `normal`, with one peak.
struct PeakedDensity {
  std::function<double(Direction light)> value;
  Direction peak;    ///< unit vector
  double width;      ///< of the peak, in radians
  Direction normal;  ///< unit vector
  bool jumps;        ///< whether it ends at the horizon with a jump; else with a kink at the most
};

/// The integral over each texel, in steradian times the density's unit. A cell is divided in four
/// until it is small against the width of the peak or its distance to it, a third of either, and
/// then integrated by 3 x 3 Gauss-Legendre nodes, or by 2 x 2 where it is a twentieth of either. On
/// the horizon cells are divided down to 1e-3 radians. Of a density that falls off like the fourth
/// power of the distance, the error is below 1e-5 of the integral over a cell.
Grid<double> texel_integrals(const PeakedDensity& density, Extent extent);

/// The density of light around an axis, by the distribution of half-vectors between it and the
/// light, without norm: D G F of the axis as normal and view.
struct Lobe {
  std::function<double(Direction light, Direction axis)> value;
  double width;  ///< in radians
  bool jumps = false;
};

/// (n·l)^exponent.
Lobe phong_lobe(double exponent);
/// D(h) (n·l) of GGX.
Lobe ggx_lobe(double alpha);
/// D(h) F(h) G1(l) of GGX with Schlick's Fresnel reflectance.
Lobe ggx_masked_lobe(double alpha, double f0);
/// (n·h)^shininess.
Lobe half_vector_lobe(double shininess);

/// The mean of a map over the lobe around an axis.
glm::dvec3 prefiltered(const Grid<Rgb>& map, const Lobe& lobe, Direction axis);

/// The means of a map over the lobe around the texel centres of a grid. Columns of one row see the
/// map turned about the poles: where the map's width is a multiple of the grid's, they share their
/// integrals.
Grid<glm::dvec3> prefiltered(const Grid<Rgb>& map, const Lobe& lobe, Extent extent);

/// What a surface of one BRDF, given as f_r (n·l)+ of the direction of light, reflects of the map:
/// its integral over all directions.
glm::dvec3 reflected(const Grid<Rgb>& map, const PeakedDensity& reflected_cosine);

}  // namespace lightproof::reference
