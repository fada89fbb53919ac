// What tells two maps apart.
#pragma once

#include <cstdint>
#include <string>

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// Name, weights, size and a hash of the texels, as bytes: of two maps that differ in any of what
/// measurements see of them, they differ as well.
std::string identity_of(const EnvironmentMap& map);

/// A hash of texels, of the bits of all their channels in their order; computed in parallel, the
/// same for any number of threads.
std::uint64_t hash_of(const Grid<Rgb>& radiance);

}  // namespace lightproof
