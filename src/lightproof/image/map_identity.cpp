#include "lightproof/image/map_identity.h"

#include <span>

#include "lightproof/core/random.h"
#include "lightproof/core/serialise.h"

namespace lightproof {

std::string identity_of(const EnvironmentMap& map) {
  ValueWriter writer;
  writer.add(map.name);
  for (const double weight : {map.weights.red, map.weights.green, map.weights.blue}) {
    writer.add(weight);
  }
  const Extent extent = map.radiance.extent();
  writer.add(extent.width);
  writer.add(extent.height);
  if (!is_plain(map.mapping)) {
    writer.add(info(map.mapping.kind).name);
    writer.add(map.mapping.shift);
  }
  const std::span<const Rgb> texels = map.radiance.values();
  writer.add(hash_text({reinterpret_cast<const char*>(texels.data()), texels.size_bytes()}));
  return writer.take();
}

}  // namespace lightproof
