// Families of estimators: what charts, tables and refusals group by.
#pragma once

#include <cstddef>
#include <string_view>

#include "lightproof/core/enumeration.h"

namespace lightproof {

/// What an estimator belongs to: what charts switch on and off together.
enum class EstimatorFamily {
  uniform,      ///< directions whatever the light and the material
  lobes,        ///< the material
  environment,  ///< the map
  product,      ///< the product of both
  mis,          ///< both, weighted
  ris,          ///< candidates of both, chosen
  points,       ///< any of these, at points that depend on each other
  lights,       ///< lights that were chosen beforehand
  quadrature,   ///< sums at fixed directions
  precomputed,  ///< look-ups in what was integrated beforehand
};

/// The name of a family: "uniform", "lobes", "environment", "product", "MIS", "RIS", "point sets",
/// "lights", "quadrature", "precomputed".
std::string_view to_string(EstimatorFamily family);

template <>
inline constexpr std::size_t kValuesOf<EstimatorFamily> = 10;

}  // namespace lightproof
