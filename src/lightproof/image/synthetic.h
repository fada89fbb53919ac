// Synthetic maps with closed forms, of any size, by name.
#pragma once

#include <span>
#include <string_view>

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// A built-in map, of which there is a closed form.
struct SyntheticMap {
  std::string_view name;
  std::string_view description;
  EnvironmentMap (*make)(Extent extent);
  /// The map on texels of another mapping: a function of directions is that of their centres, and
  /// rows and columns are those of the square.
  EnvironmentMap (*make_on)(Extent extent, const Mapping& mapping);
};

/// All built-in maps, in the order in which they are shown.
std::span<const SyntheticMap> synthetic_maps();

/// The built-in map of this name at this extent. Throws InputError listing the names if there is
/// none of this name, or saying what the mapping needs if it cannot have so many texels.
EnvironmentMap make_synthetic_map(std::string_view name, Extent extent,
                                  const Mapping& mapping = {});

}  // namespace lightproof
