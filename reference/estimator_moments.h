// Exact moments of the one-sample estimators X = L k / p(omega) of I = ∫ L k d(omega), by
// quadrature: what a measured mean, variance and error are held against.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"

namespace lightproof::reference {

/// The integrand's factor that does not depend on the map, at one direction.
struct KernelValue {
  double k = 0.0;    ///< f_r (n·omega)+ V, per steradian of incident radiance
  double pdf = 0.0;  ///< density, per steradian, with which the material draws the direction
};

struct Kernel {
  std::function<KernelValue(Direction)> at;
  /// Whether an edge of k (a horizon, a silhouette) may cross the cap of this angle in radians
  /// around the direction; such texels are split.
  std::function<bool(Direction, double)> straddles;
};

/// (n·omega)+ without occlusion; no material draws from it.
Kernel cosine_kernel(Direction normal);

/// Moments of an estimator about zero, and what follows from them.
struct EstimatorMoments {
  std::array<double, 4> raw = {};  ///< E[X], E[X^2], E[X^3], E[X^4]
  double largest = 0.0;            ///< X seen at a node; between nodes it is a few percent more

  double mean() const { return raw[0]; }
  double variance() const;
  double fourth_central() const;
};

/// The estimators of all strategies over one map.
struct LightMoments {
  EstimatorMoments uniform;        ///< p = 1 / 4 pi
  EstimatorMoments material;       ///< p = KernelValue::pdf
  EstimatorMoments environment_a;  ///< p(s,t) proportional to L
  EstimatorMoments environment_b;  ///< p(omega) proportional to L
};

/// One entry per grid of radiance L; all grids have one extent. Under A and B the density is
/// proportional to the same L, so X is bounded however bright a sun is.
std::vector<LightMoments> light_moments(const Kernel& kernel,
                                        std::span<const Grid<double>> radiance);

}  // namespace lightproof::reference
