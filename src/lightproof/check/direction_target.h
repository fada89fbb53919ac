// Distributions over directions that samples may be declared to have without any map: those of
// hemispheres, lobes, microfacets and phase functions, by name.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/gate/direction_distribution.h"

namespace lightproof {

/// A kind of distribution. The normal, or the direction in which light travels on, is +z; a view
/// lies in the plane of x and z, on the side of +x.
struct DirectionTargetInfo {
  std::string_view name;         ///< "ggx"
  std::string_view form;         ///< how it is written: "ggx:R@DEG"
  std::string_view description;  ///< one line
  bool has_parameter = false;
  double least = 0.0;  ///< of the parameter
  double most = 0.0;
  bool has_view = false;
  DirectionDistribution (*make)(double parameter, Direction view) = nullptr;
  std::vector<Alternative> (*mistakes)() = nullptr;  ///< beside what the distribution itself names
};

/// All kinds, in the order in which they are shown.
std::span<const DirectionTargetInfo> direction_targets();

/// A distribution, by the name that was asked for.
struct DirectionTarget {
  std::string name;  ///< "ggx:0.3@60"
  DirectionDistribution distribution;
  /// What could be drawn by mistake, beside what the distribution itself names.
  std::vector<Alternative> mistakes = {};
};

/// The distribution of a name with its parameters: "cosine", "phong:50", "ggx:0.3@60", where a view
/// that is not named is along the normal. None if no kind has the name. Throws InputError, which
/// says what is possible, if the parameters are missing or out of range.
std::optional<DirectionTarget> direction_target(std::string_view text);

/// The density of a distribution in a direction, per steradian.
double density_of(const DirectionDistribution& distribution, Direction d);

}  // namespace lightproof
