// Pictures of what published forms get wrong: spheres shaded by precomputed maps beside the same by
// brute force, and a reflectivity map.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lightproof/core/progress.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/results/published_picture.h"
#include "lightproof/shading/layered_light.h"

namespace lightproof {

struct ShadedPictureOptions {
  Extent picture = {160, 120};
  std::uint64_t samples = 3072;  ///< per pixel of a sphere by brute force
  std::uint64_t seed = 1;
};

/// What a form makes of a point.
using ShadePoint = std::function<glm::dvec3(const ShadingPoint& at)>;

/// A sphere in the void, three times. What is said of the picture is left empty.
PublishedPicture shaded_sphere(const EnvironmentMap& map, const LayeredSurface& surface,
                               const ShadePoint& published, const ShadePoint& corrected,
                               const ShadedPictureOptions& options);

/// 002-6: a golden sphere, by levels R mipCount and R (mipCount - 1) of five.
PublishedPicture metallic_roughness_picture(const ShadedPictureOptions& options = {});

/// 004-7: a reflectivity map of roughness 0.5 after 1024 samples, divided by the number of good
/// samples and by the sum of their weights, beside the exact one.
PublishedPicture reflectivity_picture(const ShadedPictureOptions& options = {});

/// 004-15: a glossy sphere with both maps as the program stores them, and corrected.
PublishedPicture two_maps_picture(const ShadedPictureOptions& options = {});

/// All of them, in the order of their systems.
std::vector<PublishedPicture> shaded_pictures(const ShadedPictureOptions& options = {},
                                              const Progress& progress = {});

}  // namespace lightproof
