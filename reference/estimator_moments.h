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
#include "lightproof/image/target_density.h"
#include "reference/quadrature.h"

namespace lightproof::reference {

/// The integrand's factor that does not depend on the map, at one direction.
struct KernelValue {
  double k = 0.0;    ///< f_r (n·omega)+ V, per steradian of incident radiance
  double pdf = 0.0;  ///< density, per steradian, with which the material draws the direction
};

/// What an estimator integrates the map's radiance against, over all directions.
struct Kernel {
  /// The kernel's value at a direction, a unit vector.
  std::function<KernelValue(Direction)> at;
  /// Whether an edge of k (a horizon, a silhouette) may cross the cap of this angle in radians
  /// around the direction; such texels are split. If none crosses a cap, none crosses a cap inside
  /// of it.
  std::function<bool(Direction, double)> straddles;
  /// Whether light arrives from a direction at all, neither from below a horizon nor from behind
  /// something: one answer all over a cap that no edge crosses. Empty if `at` takes care of it.
  std::function<bool(Direction)> is_lit = {};
};

/// The kernel (n·omega)+ of irradiance without occlusion; no material draws from it, so that its
/// pdf is 0.
Kernel cosine_kernel(Direction normal);

/// Moments of an estimator about zero, and what follows from them.
struct EstimatorMoments {
  std::array<double, 4> raw = {};  ///< E[X], E[X^2], E[X^3], E[X^4]
  double largest = 0.0;  ///< the largest X at any node; between nodes it is a few percent more

  double mean() const { return raw[0]; }
  /// E[X^2] - E[X]^2, but not below 0.
  double variance() const;
  /// E[(X - E[X])^4], but not below 0.
  double fourth_central() const;
};

/// A density p(omega) whose one-sample estimator X = L k / p has known moments.
enum class SampledDensity {
  uniform,        ///< 1 / 4 pi
  material,       ///< KernelValue::pdf
  texture_space,  ///< p(s,t) proportional to L
  solid_angle,    ///< p(omega) proportional to L
  sine_weighted,  ///< p(s,t) proportional to L times the texel's solid angle
};
inline constexpr std::size_t kSampledDensities = 5;

/// The density of an estimator that samples a map by this density.
constexpr SampledDensity sampled_density(DensitySpace density_space) {
  switch (density_space) {
    case DensitySpace::texture:
      return SampledDensity::texture_space;
    case DensitySpace::solid_angle:
      return SampledDensity::solid_angle;
    case DensitySpace::sine_weighted:
      return SampledDensity::sine_weighted;
  }
  __builtin_unreachable();
}

/// The moments of the one-sample estimators of every density, over one map.
class LightMoments {
 public:
  /// The moments of the estimator that draws from this density.
  EstimatorMoments& operator[](SampledDensity density) {
    return of_[static_cast<std::size_t>(density)];
  }
  const EstimatorMoments& operator[](SampledDensity density) const {
    return of_[static_cast<std::size_t>(density)];
  }
  /// Adds the raw moments of all densities; the largest value is the larger one's.
  void merge(const LightMoments& other);

 private:
  std::array<EstimatorMoments, kSampledDensities> of_;
};

/// The moments of the one-sample estimators of ∫ L k d(omega), one entry per grid of radiance L,
/// which is constant inside a texel; all grids have one extent. Under A, B and C the density
/// of a texel is proportional to the same L, so X is bounded however bright a sun is.
/// Texels are those of the mapping; the rule is for latitude and longitude, other mappings have
/// Gauss nodes.
std::vector<LightMoments> light_moments(const Kernel& kernel,
                                        std::span<const Grid<double>> radiance,
                                        const Mapping& mapping = {},
                                        CellRule rule = CellRule::gauss);

}  // namespace lightproof::reference
