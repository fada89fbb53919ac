// Published forms of shading by precomputed maps that are wrong, each on an input whose exact
// result is known.
#pragma once

#include <vector>

#include "lightproof/results/published_comparison.h"
#include "lightproof/shading/two_maps.h"

namespace lightproof {

/// 002-6: a white surface that is no metal under light of radiance 1 from all around, which absorbs
/// nothing and so reflects exactly 1. Published, the base gets 1 - F(n·v) whatever the roughness;
/// corrected, what the coat does not reflect.
PublishedComparison white_furnace_comparison(double roughness, double cosine);

/// 004-15: a white surface of roughness 0.5 and F0 = 0.04 under light of radiance 1 from all
/// around, seen along the normal: by the text's two hemispheres, or with the program's maps. Exact:
/// the surface's reflection by quadrature.
PublishedComparison two_maps_comparison(TwoMapsForm published);

/// The comparisons of 002-6 and 004-15, at inputs that show the difference.
std::vector<PublishedComparison> shading_comparisons();

/// What a grey glossy surface of the two maps' model reflects of light of radiance 1 from all
/// around along its normal, by quadrature to 1e-10.
double white_along_normal(const GlossyOnDiffuse& surface);

}  // namespace lightproof
