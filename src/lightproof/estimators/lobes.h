// Directions drawn from lobes alone, whatever the map is: of the hemisphere, of the cosine, of GGX
// in each of the ways in which its normals can be drawn, and of the material itself.
#pragma once

#include "lightproof/estimators/light_samples.h"

namespace lightproof {

/// Density 1/2pi over the hemisphere above the surface.
PreparedSource hemisphere_source(const EnvironmentMap& map);

/// Density cos/pi over the hemisphere above the surface.
PreparedSource cosine_source(const EnvironmentMap& map);

/// The material's own lobes, as it draws them.
PreparedSource material_source(const EnvironmentMap& map);

/// GGX's normals drawn in one way, whichever way the material has. Binding throws InputError for
/// other materials.
PreparedSource ggx_source(const EnvironmentMap& map, MicrofacetSampling sampling);

/// Density 1/2pi over the hemisphere, per steradian, of a direction above the surface.
double hemisphere_pdf(const Material& material, const ShadingPoint& at, Direction direction);

/// Density cos/pi, per steradian, of a direction above the surface.
double cosine_pdf(const Material& material, const ShadingPoint& at, Direction direction);

/// The density per steradian with which a GGX draws a direction if it draws its normals in one way.
double ggx_pdf(MicrofacetSampling sampling, const Material& material, const ShadingPoint& at,
               Direction direction);

/// Whether the material is a GGX.
bool is_ggx(const Material& material);

}  // namespace lightproof
