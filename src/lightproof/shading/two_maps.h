// A scene shaded with a course project's two maps, a reflectivity map and an irradiance map:
//
//   L_o = F (reflected, around the mirrored view) + c (diffuse, around the normal),
//
// as its text has it, as its program stores the maps, and corrected.
#pragma once

#include <string_view>

#include "lightproof/core/direction.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/prefilter/irradiance.h"
#include "lightproof/prefilter/specular_chain.h"

namespace lightproof {

enum class TwoMapsForm {
  /// F(n·v)/4 ∫ D 2 (n·l)+ L + c pi ∫ over the other hemisphere n·l L, which is negative: (S+2)/2pi
  /// (n·h)^S is D. The geometry factor goes to 2, the diffuse constant is pi^2 too large.
  text,
  /// What the maps hold after many frames: the mean weight of the samples that are left, 2/pi
  /// (S+2)/(S+1) (n·h), and E without 1/pi: L_o = F(n·v) map + c E. Without the rule that skips
  /// densities below 1e-4, which is one of the accumulation's own.
  program,
  /// F(n·v)/4 ∫ D min(1, 2 (n·l)+) L, which is the surface's own reflection where n = v but for the
  /// Fresnel factor, and (1 - F0) 20/21 c E/pi, which is right under a constant sky.
  corrected,
};

/// What a point is made of.
struct GlossyOnDiffuse {
  double roughness;           ///< in (0,1]; the shininess is 2/R^4 - 2
  double normal_reflectance;  ///< F0
  glm::dvec3 colour;          ///< c, the albedo below the coat
};

/// White light of radiance 1 from all around, as the reflectivity map of this form shows it.
double white_reflectivity(double roughness, TwoMapsForm form);

/// Both maps of one environment.
class TwoMaps {
 public:
  /// Reflectivity in levels of half the size, of roughness (i + 1/2)/levels, from `extent` down;
  /// irradiance at 64 x 32 normals. Exact, so that what is wrong is the form. Throws InputError if
  /// the size has not so many levels.
  TwoMaps(const EnvironmentMap& environment, Extent extent, int levels, TwoMapsForm form);

  /// The radiance towards the view; the level is 7 R - 1/2 of seven, trilinear.
  Radiance shaded(const GlossyOnDiffuse& surface, Direction normal, Direction view) const;

 private:
  TwoMapsForm form_;
  SpecularChain reflectivity_;
  Grid<Rgb> irradiance_;
};

/// The surface shaded under light of radiance 1 from all around, without maps, and so without their
/// errors.
Radiance shaded_by_white(const GlossyOnDiffuse& surface, double cosine, TwoMapsForm form);

}  // namespace lightproof
