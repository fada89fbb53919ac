// Measures which method reaches an error first, over the width of the light and of the lobe.
#pragma once

#include <cstdint>

#include "lightproof/core/kept_measurement.h"
#include "lightproof/core/progress.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/results/accuracy_chart.h"
#include "lightproof/results/method_regime.h"

namespace lightproof {

/// A map of one light from above the camera, L = exp(k (cos - 1)) (von Mises and Fisher's), which
/// fills η = (1 - e^-2k)^2 / (k (1 - e^-4k)) of the sphere.
EnvironmentMap one_light(double concentration, Extent extent);

/// Which estimator of a chart is the fastest to the error, and which of those without bias; names
/// are empty where none reaches it.
MethodRegime regime_of(const AccuracyChart& chart, double roughness, double effective_fraction);

/// Charts of GGX spheres of six roughnesses under seven lights, for an error of 5 %; half a minute,
/// kept for this machine and seed.
MethodRegimes kept_method_regimes(std::uint64_t seed, const MeasurementCache& cache,
                                  const Progress& progress = {});

}  // namespace lightproof
