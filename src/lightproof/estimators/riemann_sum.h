// Reflection by a Riemann sum over K x J directions of the hemisphere, as lectures on image-based
// lighting give it (prefilter/riemann_irradiance.h), for any material.
#pragma once

#include "lightproof/estimators/estimator.h"

namespace lightproof {

/// How many azimuths and polar angles a budget allows.
struct RiemannSteps {
  std::uint64_t azimuths;
  std::uint64_t polar;
};

/// J = sqrt(N/2) polar angles, rounded down, at least 1, and as many azimuths K as K J <= N allows:
/// about twice as many, so that both steps are alike at the horizon.
RiemannSteps riemann_steps(std::uint64_t samples);

/// The sum of L k over midpoints in azimuth and polar angle, each weighted by the cosine-weighted
/// area of its cell over the cosine, which makes the sum for a white diffuse surface exact (the
/// lecture's is off by the factor x / sin(x), x = pi / 2J). No random numbers: an estimate is off
/// by the same amount each time, by less the more samples there are.
PreparedEstimator riemann_sum(const EnvironmentMap& map);

}  // namespace lightproof
