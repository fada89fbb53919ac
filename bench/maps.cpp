#include "bench/maps.h"

#include "lightproof/image/synthetic.h"

namespace lightproof::bench {

const EnvironmentMap& map_of(Extent extent) {
  static EnvironmentMap map;
  if (!(map.radiance.extent() == extent)) {
    map = {};
    map = make_synthetic_map(kMap, extent);
  }
  return map;
}

}  // namespace lightproof::bench
