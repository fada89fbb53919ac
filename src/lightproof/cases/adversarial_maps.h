// Maps that have broken samplers, or gates, by kind and of any size: few lamps, black rows, light
// in the row of a pole, one colour.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// A kind of map, some of whose features are chosen by random numbers.
struct AdversarialMap {
  std::string_view name;
  std::string_view description;
};

/// Every kind: lamps, mirrored-lamps, noise, black-rows, bright-pole, one-colour.
std::span<const AdversarialMap> adversarial_maps();

/// A map of this kind; the same for the same extent and seed. It has light somewhere.
EnvironmentMap make_adversarial_map(const AdversarialMap& kind, Extent extent, std::uint64_t seed);

/// A map on which every mutant shows: 128 x 64, dim, so that the lower quarter falls below an
/// absolute threshold; brighter upwards and on one side; warm on one side; a sun that does not
/// outshine the rest; the first row black.
EnvironmentMap mutant_map();

}  // namespace lightproof
