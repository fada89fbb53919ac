// As estimator_moments.h, of radiance that is interpolated between the centres of texels, and drawn
// in proportion to it.
#pragma once

#include <functional>

#include "lightproof/image/target_density.h"
#include "reference/estimator_moments.h"

namespace lightproof::reference {

/// Quarters of texels are cells of the quadrature: the radiance is bilinear in each.
LightMoments bilinear_light_moments(const Kernel& kernel, const Grid<double>& radiance);

/// 1/p(omega) where the sample lies in a texel whose own value is bright, else 0: the mean, the
/// mean square and a bound of the largest value; higher moments are left at 0. Bright texels are
/// positive.
EstimatorMoments bilinear_inverse_pdf(const Grid<double>& radiance, DensitySpace density_space,
                                      const std::function<bool(double)>& is_bright);

}  // namespace lightproof::reference
