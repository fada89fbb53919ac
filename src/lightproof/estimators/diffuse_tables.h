// Diffuse reflection by what was computed of the map beforehand. Nothing is in the way of light to
// these: they know the normal alone.
#pragma once

#include "lightproof/estimators/estimator.h"

namespace lightproof {

/// The normals of tabulated irradiance.
inline constexpr Extent kTabulatedNormals = {64, 32};

/// Irradiance by nine spherical harmonics (Ramamoorthi and Hanrahan 2001, "An Efficient
/// Representation for Irradiance Environment Maps"), not below 0. Off by at most 3/32 of the light
/// of all directions, by sqrt(1/768) of it root mean square over normals. Lambert alone; binding to
/// other materials throws InputError.
PreparedEstimator harmonic_irradiance(const EnvironmentMap& map);

/// Irradiance of 64 x 32 normals, exact at these, interpolated bilinearly. Lambert alone; binding
/// to other materials throws InputError.
PreparedEstimator tabulated_irradiance(const EnvironmentMap& map);

/// Whether the material is Lambert's.
bool is_lambert(const Material& material);

}  // namespace lightproof
