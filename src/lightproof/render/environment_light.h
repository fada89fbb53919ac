// An environment map ready to light a scene.
#pragma once

#include "lightproof/image/environment_map.h"
#include "lightproof/samplers/guide_table.h"

namespace lightproof {

/// The map with a sampler of its luminance for each weighting: the fastest monotone one, so that
/// stratified points stay stratified. Refers to the map, which must outlive it.
class EnvironmentLight {
 public:
  explicit EnvironmentLight(const EnvironmentMap& map)
      : map_(&map),
        by_a_(map, on_map({Weighting::A}, map)),
        by_b_(map, on_map({Weighting::B}, map)) {}

  const EnvironmentMap& map() const { return *map_; }
  const GuideTable& sampler(Weighting weighting) const {
    return weighting == Weighting::A ? by_a_ : by_b_;
  }

 private:
  const EnvironmentMap* map_;
  GuideTable by_a_;
  GuideTable by_b_;
};

}  // namespace lightproof
