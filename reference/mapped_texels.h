// Texels of any mapping: their solid angles, the bins of (phi, theta) that parts of them lie in,
// and integrals over them. It knows mappings as functions from the square to directions, and where
// these have folds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/warp/mapping.h"
#include "reference/estimator_moments.h"
#include "reference/quadrature.h"

namespace lightproof::reference {

/// Solid angle, in steradian, of a cell that lies in one texel of a map, in closed form: between
/// parallels, a share of the sphere, or the difference of atan(a b / sqrt(1 + a^2 + b^2)) at the
/// corners of a rectangle on a cube's face.
double cell_solid_angle(const Mapping& mapping, const SquareCell& cell);

/// A part of a texel, a convex polygon of the square, and the bin over (phi, theta) that it lies
/// in.
struct BinnedPart {
  SquarePoint centre;  ///< of its area
  double area;         ///< of the square
  int column;          ///< of bins over s = 1/2 - phi/2pi of Lightproof's own frame
  int row;             ///< of bins over t = 1 - theta/pi
  /// Whether no edge of a bin comes near it. Else it was cut along such edges, which are straight
  /// in the square unless they are parallels on a cube's face.
  bool is_whole;
};

/// Divides a texel into parts that lie in one bin each: by quarters, down to 4^-`depth` of the
/// texel; what edges of bins still run through is cut along them. The points at which an edge
/// enters and leaves a part are exact, and joined by a straight line.
void visit_binned_parts(const Mapping& mapping, const SquareCell& texel, int depth, Extent bins,
                        const std::function<void(const BinnedPart&)>& visit);

/// How deep texels must be divided: once where the edges of bins are straight lines; on a cube
/// until a part is 2^-19 of the square, since a chord of length h leaves about h^3/12 times the
/// curvature of the edge.
int depth_of_parts(const Mapping& mapping, Extent texels);

/// The parts of all texels of a map, row by row, as visit_binned_parts() gives them.
std::vector<BinnedPart> binned_parts(const Mapping& mapping, Extent texels, Extent bins);

/// Masses of bins over (phi, theta).
struct BinnedMasses {
  Grid<double> masses;
  /// For each bin a bound of its error, however the edges bend: the mass of all parts that were
  /// cut.
  Grid<double> bound;
};

/// The masses of bins over (phi, theta), given the masses of texels in which the density over the
/// square is uniform.
BinnedMasses binned_masses(const Grid<double>& texel_masses, const Mapping& mapping, Extent bins);

/// Which shares of the texels of a map lie in which bins over (phi, theta), kept for many
/// densities.
class BinShares {
 public:
  /// For densities that are uniform over the square of every texel.
  BinShares(const Mapping& mapping, Extent texels, Extent bins);

  /// The masses of the bins, given the masses of the texels: those of binned_masses().
  Grid<double> masses(const Grid<double>& texel_masses) const;

 private:
  struct Share {
    std::size_t texel;
    std::size_t bin;
    double share;
  };

  /// The shares of one texel's area that lie in each of the bins that it touches.
  std::vector<Share> shares_of(const Mapping& mapping, const SquareCell& cell, int depth,
                               std::size_t texel) const;

  Extent bins_;
  std::vector<std::int32_t> bin_of_texel_;  ///< -1 for one that lies in several
  std::vector<Share> shares_;               ///< of those
};

/// Calls visit(Node) for 3 x 3 Gauss-Legendre nodes in each part of a cell inside which the mapping
/// is smooth: an octahedral map folds along both diagonals of every quarter of its square, and
/// around the poles is smooth in polar coordinates alone. The cell lies in one texel. The weights
/// of its nodes sum to its solid angle.
void visit_nodes(const Mapping& mapping, const SquareCell& cell,
                 const std::function<void(const Node&)>& visit);

/// Calls add(node, value) for nodes in one texel of a map at which a kernel is positive. The sphere
/// is divided into at least as many cells as by SphereQuadrature, and into as many as 1024 x 512
/// where an edge of the kernel may run, at which it has a kink and no jump.
void visit_kernel(const Kernel& kernel, const Mapping& mapping, Extent map, const SquareCell& texel,
                  const std::function<void(const Node&, const KernelValue&)>& add);

/// ∫ of d(omega)/(ds dt) over the directions of a texel, in sr^2 per unit square: of a density that
/// is uniform over the square of the texel it is ∫ 1/p(omega) d(omega), but for its factor.
double jacobian_integral(const Mapping& mapping, Extent map, const SquareCell& texel);

/// The largest d(omega)/(ds dt) in a texel, to the distance of the nodes of a quadrature.
double largest_jacobian(const Mapping& mapping, Extent map, const SquareCell& texel);

}  // namespace lightproof::reference
