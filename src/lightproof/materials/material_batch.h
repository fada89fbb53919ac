// Many directions of a material at once, with vectors: as its sample and evaluate, to some
// roundings.
#pragma once

#include <cstddef>
#include <span>

#include "lightproof/materials/material.h"

namespace lightproof {

/// reflected_cosine[i] = f_r (n·l)+ of the i-th direction, per steradian; of the same size. Returns
/// how many directions vectors did, from the front: 0 on a processor without vectors.
std::size_t reflected_cosines(const Material& material, const ShadingPoint& at,
                              const DirectionArrays& light, std::span<double> reflected_cosine);

/// What a material does with light from many directions; all of one size.
struct ScatteringSpans {
  std::span<double> reflected_cosine;  ///< f_r (n·l)+, per steradian
  std::span<double> pdf;  ///< per steradian, with which the material's own lobes draw the direction
};

/// What the material does with light from every direction: its value and its density. All of one
/// size. Returns how many directions vectors did, from the front: 0 on a processor without vectors.
std::size_t scatterings(const Material& material, const ShadingPoint& at,
                        const DirectionArrays& light, const ScatteringSpans& out);

/// Where sample_material writes: directions and what the material does with light from there. All
/// of one size.
struct MaterialSamples {
  std::span<double> x;
  std::span<double> y;
  std::span<double> z;
  std::span<double> pdf;               ///< per steradian
  std::span<double> reflected_cosine;  ///< f_r (n·l)+, per steradian
};

/// Draws from the material's own lobes at the points (s[i], t[i]); all of one size. Returns how
/// many samples vectors drew, from the front: 0 on a processor without vectors.
std::size_t sample_material(const Material& material, const ShadingPoint& at,
                            std::span<const double> s, std::span<const double> t,
                            const MaterialSamples& samples);

}  // namespace lightproof
