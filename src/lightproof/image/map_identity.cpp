#include "lightproof/image/map_identity.h"

#include <span>
#include <vector>

#include "lightproof/core/parallel.h"
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
  writer.add(hash_of(map.radiance));
  return writer.take();
}

std::uint64_t hash_of(const Grid<Rgb>& radiance) {
  const auto hash_bytes = [](auto values) {
    return hash_text({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  };
  const std::span<const Rgb> texels = radiance.values();
  std::vector<std::uint64_t> hashes(chunks_of(texels.size(), kTaskCells));
  parallel_chunks(texels.size(), kTaskCells,
                  [&](std::size_t chunk, std::size_t first, std::size_t end) {
                    hashes[chunk] = hash_bytes(texels.subspan(first, end - first));
                  });
  return hash_bytes(std::span<const std::uint64_t>(hashes));
}

}  // namespace lightproof
