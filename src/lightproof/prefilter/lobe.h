// Lobes that a specular map is prefiltered with: densities over directions that depend on the angle
// to the mirrored view alone. Normal, view and mirrored view are taken to be one direction
// (n = v = r), as every map with one value a direction must; so a prefiltered map is a zonal
// convolution of the environment, and a lobe is known by its zonal factors.
#pragma once

#include <variant>
#include <vector>

#include "lightproof/core/measure.h"

namespace lightproof {

/// cos^n: Phong's lobe around the mirrored view, (n+1)/2pi cos^n per steradian. With n = v = r the
/// receiver's cosine joins it, (n+2)/2pi cos^(n+1): the lobe of exponent n + 1.
struct PhongLobe {
  double exponent;  ///< n >= 0
};

/// What weighs the light that a GGX half-vector at n = v mirrors in.
enum class GgxWeight {
  cosine,   ///< (n·l)+: Karis 2013, "Real Shading in Unreal Engine 4"
  masking,  ///< F G1(l): what the BRDF at n = v asks for (Smith's masking, Schlick's Fresnel)
};

/// D(h) F G / 4 at n = v = r, D the distribution of Trowbridge and Reitz ("GGX").
struct GgxLobe {
  double alpha;  ///< in (0, 1]: the square of the perceptual roughness
  GgxWeight weight = GgxWeight::cosine;
  double f0 = 1.0;  ///< Fresnel reflectance at normal incidence, of the masking weight alone
};

/// The geometry term beside the half-vector lobe, up to its factor.
enum class GeometryTerm {
  none,           ///< 1
  cosine,         ///< 2 (n·l)+, beyond 1 from 60 degrees inwards
  cook_torrance,  ///< min(1, 2 (n·l)+): Cook and Torrance 1982 at v = n
};

/// (n·h)^S, h half-way between the mirrored view and the light: Blinn's distribution at n = v.
struct HalfVectorLobe {
  double shininess;  ///< S >= 0
  GeometryTerm geometry = GeometryTerm::none;
};

using Lobe = std::variant<PhongLobe, GgxLobe, HalfVectorLobe>;

/// alpha = R^2.
constexpr double alpha_of_roughness(double roughness) { return roughness * roughness; }

/// S = 2/R^4 - 2, which gives Blinn's distribution the slopes of GGX with alpha = R^2. Infinite at
/// R = 0, negative beyond R = 1.
constexpr double half_vector_shininess(double roughness) {
  return 2.0 / (roughness * roughness * roughness * roughness) - 2.0;
}

/// The lobe's value at this cosine to its axis, relative to the one on its axis; 0 for a cosine of
/// 0 or less.
double relative_density(const Lobe& lobe, double cosine);

/// The integral of relative_density over the sphere, in steradian.
double solid_angle(const Lobe& lobe);

/// The angle in radians over which the lobe falls off around its axis.
Radians width(const Lobe& lobe);

/// The zonal factors lambda_0 = 1, lambda_1, …, lambda_degree: the mean of the Legendre polynomial
/// P_l of the cosine over the lobe. Convolution with the lobe multiplies each spherical harmonic of
/// degree l by lambda_l. Phong's in closed form, the others by quadrature, to some 1e-14.
std::vector<double> zonal_factors(const Lobe& lobe, int degree);

/// Phong's zonal factors by their recursion, lambda_l = lambda_(l-2) (n-l+2)/(n+l+1).
std::vector<double> zonal_factors(const PhongLobe& lobe, int degree);

}  // namespace lightproof
