// A map prefiltered by lobes: for every direction the mean of the map's light, weighted by the lobe
// around that direction. By several methods, from the usual loop to one that is exact to rounding
// and faster.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/prefilter/lobe.h"

namespace lightproof {

enum class PrefilterMethod {
  uniform,              ///< samples uniform over the hemisphere, nearest look-up
  half_vector,          ///< samples by half-vectors of the distribution, nearest look-up: as usual
  lobe,                 ///< samples in proportion to the lobe, nearest look-up
  filtered,             ///< half-vectors, looked up in a mip pyramid by their solid angles
  spherical_harmonics,  ///< the series up to a degree
  fast,                 ///< the series up to where it has faded, and sums over texels where needed
};

struct PrefilterMethodInfo {
  PrefilterMethod method;
  std::string_view name;
  std::string_view description;
};

std::span<const PrefilterMethodInfo> prefilter_methods();

/// Throws InputError listing the names if there is none of this name.
PrefilterMethod prefilter_method_by_name(std::string_view name);

struct PrefilterSettings {
  PrefilterMethod method = PrefilterMethod::fast;
  int samples = 1024;  ///< of the methods that sample, at least 1
  int degree = 8;      ///< of `spherical_harmonics`, at most kLargestDegree
};

/// What is wanted of a map: prefiltered by a lobe, or as a mirror shows it, at the texel centres of
/// a grid.
struct PrefilteredLevel {
  std::optional<Lobe> lobe;  ///< none: the mirror
  Extent extent;
};

/// All levels; what they share is computed once. A mirror's texel is the mean of the map over it.
/// Values are finite and not negative. The same bits for any number of threads.
std::vector<Grid<Rgb>> prefilter(const Grid<Rgb>& map, std::span<const PrefilteredLevel> levels,
                                 const PrefilterSettings& settings = {});

/// One lobe's values at any directions: for cube faces and other projections. A mirror shows the
/// texel that a direction falls into.
std::vector<Rgb> prefilter(const Grid<Rgb>& map, const std::optional<Lobe>& lobe,
                           std::span<const Direction> directions,
                           const PrefilterSettings& settings = {});

}  // namespace lightproof
