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
};

/// All built-in maps, in the order in which they are shown.
std::span<const SyntheticMap> synthetic_maps();

/// The built-in map of this name at this extent. Throws InputError listing the names if there is
/// none of this name.
EnvironmentMap make_synthetic_map(std::string_view name, Extent extent);

}  // namespace lightproof
