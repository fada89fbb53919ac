// An environment map ready to light a scene.
#pragma once

#include "lightproof/image/environment_map.h"
#include "lightproof/samplers/guide_table.h"

namespace lightproof {

/// The map with a sampler of its luminance for each density: the fastest monotone one, so that
/// stratified points stay stratified. Refers to the map, which must outlive it.
class EnvironmentLight {
 public:
  explicit EnvironmentLight(const EnvironmentMap& map)
      : map_(&map),
        by_a_(map, on_map({DensitySpace::texture}, map)),
        by_b_(map, on_map({DensitySpace::solid_angle}, map)) {}

  const EnvironmentMap& map() const { return *map_; }
  const GuideTable& sampler(DensitySpace density_space) const {
    return density_space == DensitySpace::texture ? by_a_ : by_b_;
  }

 private:
  const EnvironmentMap* map_;
  GuideTable by_a_;
  GuideTable by_b_;
};

}  // namespace lightproof
