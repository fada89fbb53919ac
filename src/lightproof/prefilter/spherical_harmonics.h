// Real spherical harmonics of any degree: projection of a map, evaluation, and irradiance, which in
// them is a product (Ramamoorthi & Hanrahan 2001, "An Efficient Representation for Irradiance
// Environment Maps"; Basri & Jacobs 2003). Degree 2, nine coefficients, is what real-time renderers
// keep.
//
// Convention: orthonormal over the sphere, without the Condon-Shortley phase, so that Y(1,-1),
// Y(1,0) and Y(1,1) are sqrt(3/4pi) times y, z and x. For m > 0, Y(l,m) goes with cos(m phi), for
// m < 0 with sin(|m| phi). Coefficient (l,m) stands at l (l + 1) + m.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "lightproof/image/environment_map.h"
#include "lightproof/prefilter/irradiance_map.h"

namespace lightproof {

/// Degrees that projection and evaluation take.
inline constexpr int kLargestHarmonicDegree = 1000;

/// How many harmonics there are up to a degree.
constexpr std::size_t harmonic_count(int degree) {
  return static_cast<std::size_t>(degree + 1) * static_cast<std::size_t>(degree + 1);
}
constexpr std::size_t harmonic_index(int l, int m) {
  return static_cast<std::size_t>(l * (l + 1) + m);
}

/// Coefficients of a function over directions, of red, green and blue, up to a degree.
struct SphericalHarmonics {
  int degree = 0;
  std::vector<glm::dvec3> coefficients = std::vector<glm::dvec3>(1, glm::dvec3(0.0));

  glm::dvec3& operator()(int l, int m) { return coefficients[harmonic_index(l, m)]; }
  const glm::dvec3& operator()(int l, int m) const { return coefficients[harmonic_index(l, m)]; }
};

/// Y(l,m) of a unit vector, all up to the degree.
std::vector<double> harmonics_at(Direction direction, int degree);

/// The sum of all harmonics at a unit vector.
glm::dvec3 evaluate(const SphericalHarmonics& function, Direction direction);

/// ∫ L Y(l,m) d(omega) of a map that is constant inside each texel, exact but for rounding: sums
/// over sines and cosines of the columns' edges in longitude, Gauss's rule in latitude with an
/// error below 1e-16. In the map's radiance times the square root of a steradian. Throws InputError
/// unless 0 <= degree <= kLargestHarmonicDegree. Time grows as W H times the degree, plus H times
/// its square.
SphericalHarmonics project(const EnvironmentMap& map, int degree);

/// The factor A of degree l by which irradiance follows from radiance, E(l,m) = A L(l,m): pi,
/// 2pi/3, pi/4, 0, -pi/24, 0, pi/64, …
double clamped_cosine_factor(int l);

/// The harmonics of the irradiance, from those of the radiance.
SphericalHarmonics irradiance_harmonics(const SphericalHarmonics& radiance);

/// The irradiance by its harmonics, of the normals of a latitude-longitude map; of few harmonics it
/// may be negative. Throws InputError if `normals` has no texels.
IrradianceMap irradiance_map(const SphericalHarmonics& irradiance, Extent normals);

/// What irradiance up to a degree leaves out at most, over all L >= 0, in units of ∫ L d(omega). A
/// single direction of light attains both.
struct HarmonicTruncation {
  double largest;           ///< of all normals; for degree 2 it is 3/32, at the horizon
  double root_mean_square;  ///< over the sphere of normals; for degree 2 it is 1/sqrt(768)
};
HarmonicTruncation irradiance_truncation(int degree);

/// The root mean square over the sphere of normals of what irradiance up to `kept` leaves out of
/// one map, as far as `radiance` goes, in red, green and blue.
glm::dvec3 omitted_irradiance(const SphericalHarmonics& radiance, int kept);

}  // namespace lightproof
