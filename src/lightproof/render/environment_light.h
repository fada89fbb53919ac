// An environment map ready to light a scene, its directions drawn from one source.
#pragma once

#include <optional>

#include "lightproof/image/environment_map.h"
#include "lightproof/image/lat_long_texels.h"
#include "lightproof/render/direction_source.h"
#include "lightproof/samplers/guide_table.h"

namespace lightproof {

/// A map as a light, and, if directions are drawn from it, a sampler of its luminance: the fastest
/// monotone one, so that stratified points stay stratified. Refers to the map, which must outlive
/// it.
class EnvironmentLight {
 public:
  EnvironmentLight(const EnvironmentMap& map, DirectionSource source)
      : map_(&map), source_(source) {
    require_lat_long(map, "light on a scene");
    if (const auto* density = std::get_if<MapDensity>(&source)) {
      sampler_.emplace(map, on_map({density->density_space}, map));
    }
  }

  const EnvironmentMap& map() const { return *map_; }
  const DirectionSource& source() const { return source_; }
  /// The sampler of the map's luminance; there if the source is a MapDensity.
  const std::optional<GuideTable>& sampler() const { return sampler_; }
  std::size_t table_bytes() const { return sampler_ ? sampler_->table_bytes() : 0; }

 private:
  const EnvironmentMap* map_;
  DirectionSource source_;
  std::optional<GuideTable> sampler_;
};

}  // namespace lightproof
