// The published diffuse formulas that are wrong or incomplete, each on an input with a closed form.
#pragma once

#include <vector>

#include "lightproof/prefilter/riemann_irradiance.h"
#include "lightproof/results/published_comparison.h"

namespace lightproof {

/// Reflection of constant light of radiance 1 by a white surface, by a Riemann sum: exactly 1.
PublishedComparison riemann_comparison(RiemannRule rule);

/// The shaded radiance of a white surface under constant light of radiance 1, c pi E against c
/// E/pi: exactly 1.
PublishedComparison diffuse_factor_comparison();

/// Irradiance of constant light of radiance 1 from the hemisphere that is integrated: exactly pi.
PublishedComparison hemisphere_comparison();

/// Irradiance of constant light of radiance 1 by uniform directions: exactly pi.
PublishedComparison uniform_density_comparison();

/// The share of constant light that enters a diffuse surface under a coat of reflectance f0 at
/// normal incidence: exactly (1 - f0) 20/21.
PublishedComparison transmittance_comparison(double f0);

/// All of them, with J = 10 and f0 = 0.04.
std::vector<PublishedComparison> diffuse_comparisons();

}  // namespace lightproof
