// The maps that samplers are timed on: one scene, in all sizes.
#pragma once

#include <array>
#include <string_view>

#include "lightproof/image/environment_map.h"

namespace lightproof::bench {

inline constexpr std::string_view kMap = "sun-sky";
inline constexpr std::array<Extent, 7> kExtents = {
    {{256, 128}, {512, 256}, {1024, 512}, {2048, 1024}, {4096, 2048}, {8192, 4096}, {16384, 8192}}};

/// Between a size and the next one, for the growth of the time per sample: where a line bends can
/// only be found among many sizes.
constexpr Extent half_as_large_again(Extent extent) {
  return {extent.width / 2 * 3, extent.height / 2 * 3};
}

/// The map of this size. It stays until another size is asked for: benchmarks of one size follow
/// each other, so one map at a time is enough.
const EnvironmentMap& map_of(Extent extent);

}  // namespace lightproof::bench
