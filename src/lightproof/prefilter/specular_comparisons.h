// Published forms of specular image-based lighting beside the corrected ones and the exact values:
// one function for each statement that differs. For tables; the methods themselves are elsewhere.
#pragma once

#include <cstdint>
#include <vector>

#include "lightproof/results/published_comparison.h"

namespace lightproof {

/// 002-5: the scale A of the BRDF integration map with Karis's masking, by the lecture's points n =
/// 1 … N, and by n = 0 … N - 1. Exact: quadrature.
PublishedComparison hammersley_range_comparison(double cosine, double roughness,
                                                std::uint32_t count);

/// 002-5: the scale A, whose G_Smith the lecture leaves open: with Karis's fit, and with Smith's
/// height-correlated masking. Exact: the latter by quadrature.
PublishedComparison masking_comparison(double cosine, double roughness, std::uint32_t count);

/// 002-6: the level that a roughness is looked up at: R mipCount, and R (mipCount - 1).
PublishedComparison level_of_roughness_comparison(double roughness, int levels);

/// 004-1: the mean of `frames` equal frames of mean 1: the weights that the text swaps make it 1 -
/// 1/k!. Exactly 1.
PublishedComparison progressive_mean_comparison(int frames);

/// 004-1: the sum of the squared weights of `frames` equal frames, by which the variance of a frame
/// is multiplied: it tends to 1 with swapped weights. Exactly 1/k.
PublishedComparison progressive_variance_comparison(int frames);

/// 004-1: the mean of `samples` samples that are 1000 with probability 1/1000 and else 0, a frame
/// of one sample each: blended in single precision as in the code, and in double with compensation.
/// Exact: counted.
PublishedComparison progressive_precision_comparison(std::uint64_t samples);

/// 004-4: the shininess of level i of n: of roughness i + 1/2, and of (i + 1/2)/n.
PublishedComparison shininess_comparison(int level, int levels);

/// 004-5: the integral of the half-vector's density over the hemisphere, whatever the shininess:
/// (S+1) cos^S lacks 1/2pi. Exactly 1.
PublishedComparison half_vector_density_comparison();

/// 004-6: the mean over all draws of the weight D/pdf, those from below the horizon included.
/// Exactly 1.
PublishedComparison weight_comparison(double shininess);

/// 004-7: a white map after skipping and renormalising: divided by the number of good samples,
/// (2/pi) (1 - 2^(-(S+2)/2))/(1 - 2^(-(S+1)/2)), and by the sum of their weights. Exactly 1. The
/// published rule that skips densities below 1e-4 is left out: see skipped_share.
PublishedComparison white_map_comparison(double roughness);

/// 004-8: how many of a frame's random numbers the next frame draws again, on average, because a
/// texel draws on until one sample is good. Exactly 0.
PublishedComparison repeated_draws_comparison(double roughness, int samples);

/// 004-9: a white map by the formula D G/4 with F = 1: with G = 2 (n·l)+, 2 (S + 2^(-S/2))/(S + 4),
/// and with Cook and Torrance's G = min(1, 2 (n·l)+).
PublishedComparison geometry_comparison(double roughness);

/// 004-10: the height of a map of this width.
PublishedComparison height_comparison(int width);

/// 004-14: the light that GGX (height-correlated masking) reflects of a white sky: Schlick's
/// reflectance of the mirrored direction taken out of the integral, F(n·v) (A + B), and the split
/// sum F0 A + B, which is exact here.
PublishedComparison fresnel_at_mirror_comparison(double f0, double cosine, double roughness);

/// The comparisons of this header, at inputs that show the difference.
std::vector<PublishedComparison> specular_comparisons();

/// The share of half-vectors that mirror light from below the horizon when n = v: alpha^2/(1 +
/// alpha^2) of GGX's, 2^(-(S+1)/2) of those drawn by cos^S.
double ggx_below_horizon(double alpha);
double half_vector_below_horizon(double shininess);

/// The share of draws that the published rule skips, densities (S+1) cos^S below 1e-4: (1e-4/(S+1))
/// to the power of (S+1)/S; 0 for S = 0.
double skipped_share(double shininess);

/// The variance of the corrected weight over all draws: 1/((S+1)(S+3)).
double weight_variance(double shininess);

/// A white map by each geometry term, the formula D G/4 of 004-9 at F = 1: none (as in the shader),
/// 2 (n·l)+, and Cook and Torrance's.
double white_without_geometry(double shininess);
double white_with_cosine_geometry(double shininess);
double white_with_cook_torrance(double shininess);

}  // namespace lightproof
