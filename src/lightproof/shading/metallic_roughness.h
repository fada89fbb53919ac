// A surface of base colour, metallic and roughness, shaded by maps that were computed before: the
// fragment shader of the lecture "Example: Split-Sum-Approximation", as published and corrected.
// Its textures are read by this library's convention `z-up`; the lecture's turns by half a turn
// about z.
#pragma once

#include <glm/vec3.hpp>

#include "lightproof/core/direction.h"
#include "lightproof/core/measure.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/prefilter/brdf_map.h"
#include "lightproof/prefilter/irradiance.h"
#include "lightproof/prefilter/specular_chain.h"

namespace lightproof {

/// What the textures hold at a point; colours linear.
struct MetallicRoughness {
  glm::dvec3 base_colour = glm::dvec3(1.0);  ///< albedo, or F0 of a metal
  glm::dvec3 emission = glm::dvec3(0.0);     ///< radiance
  double roughness = 0.5;                    ///< in [0,1]
  double metallic = 0.0;                     ///< in [0,1]
  double reflectance = 0.5;                  ///< F0 of what is no metal is 0.16 times its square
};

/// F0: mix(0.16 reflectance^2, base colour, metallic).
glm::dvec3 normal_reflectance(const MetallicRoughness& surface);

/// The share of the light that the surface below the coat gets.
enum class DiffuseShare {
  published,  ///< kD = (1 - F(n·v)) (1 - metallic), Schlick's F whatever the roughness
  remaining,  ///< (1 - (F0 A + B)) (1 - metallic): what the coat does not reflect
};

/// What the maps hold for one normal and view.
struct PrecomputedLight {
  glm::dvec3 prefiltered;  ///< S, around the mirrored view
  ScaleBias brdf;          ///< A and B at (n·v, roughness)
  glm::dvec3 diffuse;      ///< E/pi around the normal: a radiance
};

/// emission + kD base diffuse + S (F0 A + B), linear. `cosine` is n·v, in [0,1].
Radiance shaded(const MetallicRoughness& surface, double cosine, const PrecomputedLight& light,
                DiffuseShare share = DiffuseShare::published);

/// Values of textures and of the screen: c^(1/2.2), and c^2.2 back.
glm::dvec3 display_encoded(Radiance radiance);
glm::dvec3 display_decoded(glm::dvec3 encoded);

/// The level that a roughness is looked up at.
enum class LevelForm {
  published,  ///< R mipCount: passes the last level, and lies beyond the right one everywhere
  corrected,  ///< R (mipCount - 1)
};

/// The maps of one environment.
class MetallicRoughnessMaps {
 public:
  /// A chain of GGX levels from `extent` down, a BRDF integration map of 256 x 256 texels with
  /// Smith's height-correlated masking, and a diffuse map (E/pi) of 64 x 32. Throws InputError if
  /// the size has not so many levels.
  MetallicRoughnessMaps(const EnvironmentMap& environment, Extent extent, int levels);

  PrecomputedLight look_up(double roughness, Direction normal, Direction view,
                           LevelForm form) const;

 private:
  SpecularChain chain_;
  Grid<ScaleBias> brdf_;
  Grid<Rgb> diffuse_;
};

/// The whole shader, without the encoding for the screen. Unit vectors; a view from behind counts
/// as one along the surface.
Radiance shaded(const MetallicRoughness& surface, const MetallicRoughnessMaps& maps,
                Direction normal, Direction view, LevelForm form);

/// Interpolated between the centres of the four nearest texels, clamped at the edges.
ScaleBias look_up(const Grid<ScaleBias>& map, double cosine, double roughness);

namespace published {

/// directionToSphericalEnvmap: s = 1 - frac(phi/2pi), in (0,1]; t = acos(-z)/pi.
SquarePoint position_on_map(Direction direction);

/// Where the background's sphere looks up the environment: (1 - tc.x, tc.y). Right for texture
/// coordinates that grow with the azimuth, tc = (phi/2pi, 1 - theta/pi).
SquarePoint background_position(SquarePoint texture_coordinate);

}  // namespace published

/// The texture coordinate of a direction on such a sphere, in [0,1).
SquarePoint background_coordinate(Direction direction);

}  // namespace lightproof
