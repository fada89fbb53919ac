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

/// Whether the material is a GGX.
bool is_ggx(const Material& material);

}  // namespace lightproof
