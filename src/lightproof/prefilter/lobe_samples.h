// Directions around a lobe's axis with which a sampling method prefilters: the same ones for every
// texel of a level, as the loops of real-time engines have it.
#pragma once

#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/prefilter/lobe.h"

namespace lightproof {

/// How the directions are drawn.
enum class LobeSampling {
  uniform,      ///< uniformly over the lobe's hemisphere
  half_vector,  ///< by mirroring in a half-vector of the distribution, as usual; Phong's lobe
                ///< itself
  lobe,         ///< in proportion to the lobe
};

/// A direction around +z and its share of the result; what lies below the horizon is left out.
struct LobeSample {
  Direction local;
  double weight;     ///< those of a level sum to 1
  PerSteradian pdf;  ///< with which it was drawn
};

/// From the first `count` Hammersley points. Divided by the sum of the weights, as Karis 2013 does:
/// a constant map stays constant.
std::vector<LobeSample> lobe_samples(const Lobe& lobe, LobeSampling sampling, int count);

/// cos(theta) of a GGX half-vector, drawn in proportion to D cos(theta) by inversion:
/// sqrt((1 - u)/(1 + (alpha^2 - 1) u)).
double ggx_half_vector_cosine(double alpha, double u);

/// cos(theta) of a half-vector drawn in proportion to cos^S(theta): u^(1/(S+1)).
double half_vector_cosine(double shininess, double u);

}  // namespace lightproof
