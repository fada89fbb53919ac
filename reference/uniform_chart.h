// Distributions over directions, each in coordinates of its own in which it is uniform: what a
// right sampler draws fills the unit square evenly, however narrow its lobe is. The normal is +z.
#pragma once

#include <functional>
#include <optional>

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"

namespace lightproof::reference {

/// A map of the directions that can be drawn to the unit square which takes their distribution to
/// the uniform one. The two functions are each other's inverse, and an area ds dt is the solid
/// angle ds dt / pdf.
struct UniformChart {
  /// None for a direction that the distribution cannot give. One that is outside by less than 1e-6,
  /// by rounding, is put on the edge.
  std::function<std::optional<SquarePoint>(Direction)> square_from_direction;
  std::function<Direction(SquarePoint)> direction_from_square;
  /// 0 where square_from_direction has nothing.
  std::function<PerSteradian(Direction)> pdf;
};

/// Density (n+1)/2pi (axis.d)^n on the side of the axis.
UniformChart cosine_lobe_chart(Direction axis, double exponent);

/// Henyey and Greenstein's phase function (1941) around +z, the direction in which light travels
/// on: (1 - g^2) / (4 pi (1 + g^2 - 2 g z)^(3/2)), g in (-1,1). g = 0 is uniform over the sphere.
UniformChart henyey_greenstein_chart(double g);

/// Microfacet normals in proportion to D(h) (n.h).
struct NormalDistribution {
  enum class Kind {
    ggx,    ///< of this alpha (Walter et al. 2007)
    blinn,  ///< D proportional to the cosine to this power (Blinn 1977)
  };
  Kind kind;
  double parameter;
};

/// Directions that the view, above the surface, is mirrored to at normals drawn by D(h) (n.h). Both
/// sides of a normal mirror alike, so that every direction of the sphere has one normal.
UniformChart mirrored_at_normals(NormalDistribution distribution, Direction view);

/// Directions that the view is mirrored to at the normals that it sees, those of GGX. Coordinates
/// are those of the projected hemisphere: an abscissa of a half disc and half ellipse, and the
/// share of the chord there (Heitz 2018, section 3).
UniformChart mirrored_at_visible_normals(double alpha, Direction view);

/// Directions that the view is mirrored to at the part of the visible normals that bounds a
/// spherical cap: as `view` sees the
/// hemisphere of normals, directions are uniform above the height of the lowest one that is above
/// the surface (Tokuyoshi & Eto 2023). Coordinates are height and azimuth on the cap.
UniformChart mirrored_at_bounded_normals(double alpha, Direction view);

}  // namespace lightproof::reference
