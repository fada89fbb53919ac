// A map of a study, and its figures.
#pragma once

#include <string>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"
#include "lightproof/image/environment_map.h"

namespace lightproof {

/// A map as the report shows it.
struct MapRecord {
  EnvironmentMap map;               ///< in texels of latitude and longitude
  Mapping own_mapping = {};         ///< of the file's texels, in which the gate judges samplers
  Extent own_texels = {};           ///< how many these are
  std::string source;               ///< the map's name, unique in the study
  double mean_luminance = 0.0;      ///< mean over the sphere by solid angle
  double peak_ratio = 0.0;          ///< luminance of the brightest texel / mean luminance
  double effective_fraction = 0.0;  ///< G^2/(4 pi Q): share of the sphere that the light fills
  std::vector<SquarePoint> drawn;   ///< some hundred samples of binary_search, density B
};

}  // namespace lightproof
