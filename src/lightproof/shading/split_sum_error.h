// What the split sum gets wrong: the radiance that a GGX surface reflects of a map, L_o = ∫ L k
// d(omega) with k = f_r (n·l)+, against the product of the prefiltered map in the mirrored
// direction and the reflectance of the BRDF integration map, (F0 A + B) ∫ L q d(omega) (Karis 2013,
// "Real Shading in Unreal Engine 4"). Both parts are exact here: no levels, no tables, no samples.
//
// The error of one orientation of surface and view in the map is ∫ L d, d = k - (F0 A + B) q. Its
// mean square over all orientations needs no rotation: in spherical harmonics, with the powers
// P_l[f] = sum over m of f(l,m)^2,
//
//   <(∫ L d)^2> = sum over l of P_l[L] P_l[d] / (2l + 1),   <∫ L k> = (1/4pi) ∫ L ∫ k,
//
// since a rotation mixes the harmonics of one degree alone, and uniformly (Schur's orthogonality).
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// The degree of spherical harmonics up to which both angular powers are computed.
inline constexpr int kSplitSumDegree = 160;

/// A function over directions as far as rotations leave it alone.
struct AngularPower {
  std::vector<double> of_degree;  ///< P_l, l = 0 … degree
  double beyond = 0.0;            ///< the sum of P_l over all further degrees

  static auto fields(auto& power) { return std::tie(power.of_degree, power.beyond); }
};

/// One surface and view.
struct SplitSumKernel {
  double reflectance = 0.0;  ///< F0 A + B = ∫ k
  AngularPower difference;   ///< of k - (F0 A + B) q, per steradian squared

  static auto fields(auto& kernel) { return std::tie(kernel.reflectance, kernel.difference); }
};

/// GGX with Smith's height-correlated masking and Schlick's Fresnel factor, against the lobe of
/// Karis, D (n·l)+ at n = v = r; one for each F0 in [0,1]. `roughness` in (0, 1], `cosine` of the
/// view to the normal in (0, 1]. By quadrature: ∫ k is right to 1e-6.
std::vector<SplitSumKernel> split_sum_kernels(double roughness, double cosine,
                                              std::span<const double> normal_reflectances,
                                              int degree = kSplitSumDegree);

/// The angular power of a map's luminance. A map that is wider than kSplitSumWidth is
/// averaged to that width first, which changes no mean. The coefficients of what is left are exact.
AngularPower luminance_power(const EnvironmentMap& map, int degree = kSplitSumDegree);
inline constexpr int kSplitSumWidth = 1024;

struct SplitSumError {
  double rmse;      ///< root mean square over all orientations, over the mean of what is reflected
  double left_out;  ///< what further degrees would add in quadrature, at most
};

/// The error of the split sum over all orientations of a map, from the kernel's and the map's
/// angular power, which have one degree. It is 0 for a black map.
SplitSumError split_sum_error(const SplitSumKernel& kernel, const AngularPower& luminance);

}  // namespace lightproof
