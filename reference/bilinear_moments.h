// Exact moments of the one-sample estimators of estimator_moments.h where the radiance is
// interpolated between the centres of texels, and the densities are proportional to it so.
#pragma once

#include <functional>

#include "lightproof/image/target_density.h"
#include "reference/estimator_moments.h"

namespace lightproof::reference {

/// The moments of the one-sample estimators of ∫ L k d(omega) for radiance L that is interpolated
/// bilinearly, by a quadrature in quarters of texels: L is bilinear in each.
LightMoments bilinear_light_moments(const Kernel& kernel, const Grid<double>& radiance);

/// Mean, mean square and a bound of the largest value of the estimator that is 1/p(omega) where the
/// sample lies in a texel whose own value is bright, and 0 elsewhere; p interpolates the radiance
/// as the density does. Its higher moments are left at 0. Bright texels must be positive.
EstimatorMoments bilinear_inverse_pdf(const Grid<double>& radiance, DensitySpace density_space,
                                      const std::function<bool(double)>& is_bright);

}  // namespace lightproof::reference
