// Many maps, of which few are in memory at once.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lightproof/image/environment_map.h"

namespace lightproof {

/// A map that is there when it is asked for, and what is known of it without its texels.
struct MapSource {
  std::string name;
  std::string source;  ///< what the user called it: a path or a built-in name
  Extent extent;
  Mapping mapping;
  LuminanceWeights weights;
  /// The map. As long as anybody holds it, everybody gets the same one; any thread may ask. Throws
  /// InputError if it cannot be read again, or is another one by now.
  std::function<std::shared_ptr<const EnvironmentMap>()> load;
};

/// Maps that are in memory already, and outlive the sources.
std::vector<MapSource> sources_of(std::span<const EnvironmentMap> maps);

/// Keeps the maps that were asked for last, as far as they have few enough texels together, but
/// always the last one; reads the others again when their turn comes.
class MapStore {
 public:
  /// 25 MB of maps.
  static constexpr std::size_t kMostTexels = std::size_t{1} << 21U;

  explicit MapStore(std::size_t most_texels = kMostTexels);

  /// Adds a map that was read, with what reads it again: the same name, weights and texels. The
  /// source may outlive the store.
  MapSource add(EnvironmentMap map, std::function<EnvironmentMap()> read_again);

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace lightproof
