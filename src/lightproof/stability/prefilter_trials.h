// What hard inputs do to maps and tables that are computed beforehand, and to means that are
// refined frame by frame. Each is named after its case.
#pragma once

#include "lightproof/stability/stability_case.h"

namespace lightproof {

/// The largest relative error of a white map of radiance 1 that is prefiltered by GGX of this
/// perceptual roughness; NaN if a value is not finite.
double white_furnace_error(const PrefilterMethodInfo& method, double roughness);

/// By how much the light of a map, a sun in one texel over a sky of 1, changes when it is
/// prefiltered by a wide lobe, to a level of this size; relative.
double energy_error(const PrefilterMethodInfo& method, float sun, Extent output);

/// What of the table is not finite or not in [0,1], with the light that is reflected at F0 = 1 at
/// most 1; empty if nothing is.
std::string_view fault_of(const ScaleBias& entry);

namespace trials {

Finding black_map(const PrefilterMethodInfo& method, const TrialOptions& options);
Finding seam(const PrefilterMethodInfo& method, const TrialOptions& options);
Finding exposure(const PrefilterMethodInfo& method, const TrialOptions& options);
Finding rotation(const PrefilterMethodInfo& method, const TrialOptions& options);
Finding orientation(const PrefilterMethodInfo& method, const TrialOptions& options);
Finding white_furnace(const PrefilterMethodInfo& method, const TrialOptions& options);
Finding roughness_zero(const PrefilterMethodInfo& method, const TrialOptions& options);
Finding little_roughness(const PrefilterMethodInfo& method, const TrialOptions& options);
Finding sun_energy(const PrefilterMethodInfo& method, const TrialOptions& options);
Finding output_sizes(const PrefilterMethodInfo& method, const TrialOptions& options);
Finding odd_sizes(const PrefilterMethodInfo& method, const TrialOptions& options);
Finding pure_colours(const PrefilterMethodInfo& method, const TrialOptions& options);
Finding denormal_map(const PrefilterMethodInfo& method, const TrialOptions& options);
Finding two_maps(const PrefilterMethodInfo& method, const TrialOptions& options);

Finding black_map(const ReflectivityMethod& method, const TrialOptions& options);
Finding white_furnace(const ReflectivityMethod& method, const TrialOptions& options);
Finding roughness_zero(const ReflectivityMethod& method, const TrialOptions& options);

Finding grazing_view(const BrdfTableMethod& method, const TrialOptions& options);

Finding many_samples(const MeanMethod& method, const TrialOptions& options);

}  // namespace trials
}  // namespace lightproof
