// What tells two maps apart.
#pragma once

#include <string>

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// Name, weights, size and a hash of the texels, as bytes: of two maps that differ in any of what
/// measurements see of them, they differ as well.
std::string identity_of(const EnvironmentMap& map);

}  // namespace lightproof
