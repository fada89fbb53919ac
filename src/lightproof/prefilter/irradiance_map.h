// Irradiance of many normals, exactly, and as a map of normals.
//
// How: one hemisphere of the map with the light of opposite directions added up (folded_row.h), one
// hemisphere of normals. In a row of the map a normal sees one run of texels, and beside it few
// that its horizon crosses. The run is a difference of two running sums of L w along the row; the
// weights of the others come in closed form (cosine_band.h), and normals of one latitude at steps
// of whole texels share them. So a map of 64 x 32 normals costs little more than reading the
// source, and nothing is approximated. What was tried beside it, for 512 x 256 texels and 64 x 32
// normals on one core: a quadtree of vectors ∫ L w visits 3600 nodes for each normal and stands at
// 60 ms before it divides a single texel at the horizon; convolution by Fourier transforms along
// the rows is as exact, but takes 2 ms and, before the first map, 9 ms for the spectra of the
// kernels; harmonics of low degree miss a sun's horizon by 9 % of its light.
#pragma once

#include <span>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/prefilter/irradiance.h"

namespace lightproof {

/// E of the normals at the centres of a latitude-longitude map's texels (`z-up`, row 0 around the
/// nadir), red, green and blue: the source's radiance times steradian.
struct IrradianceMap {
  Grid<glm::dvec3> irradiance;
};

/// E/pi of the same normals, what a white Lambertian surface reflects: a radiance. This is what
/// renderers call a diffuse map, and multiply by the surface's colour.
struct DiffuseMap {
  Grid<glm::dvec3> radiance;
};

/// A map of zeros, for whoever fills it. Throws InputError if it has no texels.
IrradianceMap dark_irradiance_map(Extent normals);

DiffuseMap diffuse_map(const IrradianceMap& map);

/// Rounded to float, as maps are stored.
Grid<Rgb> rounded(const Grid<glm::dvec3>& values);

/// Normal of a texel.
Direction normal_of_texel(Extent normals, int x, int y);

/// Exact but for rounding: errors of some 1e-16 times the sum of a row's texels; what rounding
/// takes below zero is zero. The same bits whatever the number of threads. Any two sizes; quickest
/// where both widths are even and the source's is a multiple of the other, or nearly so (many
/// common divisors). Throws InputError if `normals` has no texels.
IrradianceMap irradiance_map(const EnvironmentMap& source, Extent normals);

/// The irradiance at any unit vectors, in their order, as irradiance_map() computes it: of cube
/// faces, of probes.
std::vector<Irradiance> irradiances(const EnvironmentMap& source,
                                    std::span<const Direction> normals);

/// How far a map is off, relative to the mean of E over all normals, which is a quarter of the
/// light ∫ L d(omega); the larger of red, green and blue, of those that have light.
struct IrradianceError {
  double largest = 0.0;
  double root_mean_square = 0.0;  ///< over the sphere of normals
};

/// Both of one size.
IrradianceError error_of(const IrradianceMap& map, const IrradianceMap& exact);

}  // namespace lightproof
