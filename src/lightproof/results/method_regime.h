// Which method wins where: over how narrow the light is and how narrow the material's lobe.
#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "lightproof/results/estimator_family.h"

namespace lightproof {

/// The method that reaches an error first, under one light and in one material.
struct MethodRegime {
  double roughness = 0.0;  ///< of GGX
  /// The share of the sphere that the light fills, η = (∫L)^2 / (4π ∫L^2).
  double effective_fraction = 0.0;
  std::string estimator;                  ///< empty if none reaches the error
  std::optional<EstimatorFamily> family;  ///< its family; none if none reaches the error
  double seconds = 0.0;                   ///< of a shading point, without set-up
  std::string unbiased_estimator;  ///< the first one without bias; empty if none reaches the error
  double unbiased_seconds = 0.0;

  static auto fields(auto& regime) {
    return std::tie(regime.roughness, regime.effective_fraction, regime.estimator, regime.family,
                    regime.seconds, regime.unbiased_estimator, regime.unbiased_seconds);
  }
};

/// A grid of them.
struct MethodRegimes {
  double error = 0.0;  ///< that is reached: root mean square over the mean
  std::vector<MethodRegime> regimes;
  std::string origin;  ///< when, where and of what it was measured

  static auto fields(auto& all) { return std::tie(all.error, all.regimes, all.origin); }
};

}  // namespace lightproof
