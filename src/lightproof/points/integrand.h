// Integrands over the unit square whose mean and variance are known in closed form: what the errors
// of point sets are measured on.
#pragma once

#include <span>
#include <string_view>

#include "lightproof/core/measure.h"

namespace lightproof {

/// What bounds the rate at which errors fall.
enum class Roughness {
  smooth,  ///< all derivatives are bounded: N^(-3/2) on a scrambled net, up to logarithms
  kink,    ///< a derivative jumps at a curve: N^(-5/4)
  edge,    ///< the value jumps at a curve: N^(-3/4)
};

/// A row of the table.
struct Integrand {
  std::string_view name;         ///< "half-lit map"
  std::string_view description;  ///< its formula
  Roughness roughness;
  double mean;      ///< its integral
  double variance;  ///< of its value at a uniform point
  double (*at)(SquarePoint point);
};

/// All of them. Those of a map are 4 pi L (n . omega)+ at the direction omega that the equal-area
/// map z = 2 t - 1, phi = 2 pi s gives; their mean is the irradiance. Neither the normal's horizon
/// nor the map's edge is a line along an axis of the square, which nets would resolve too well.
std::span<const Integrand> integrands();

/// Throws InputError, which lists the names, if there is none of this name.
const Integrand& integrand_by_name(std::string_view name);

}  // namespace lightproof
