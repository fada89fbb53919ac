// An environment map ready to light a scene.
#pragma once

#include "lightproof/image/environment_map.h"
#include "lightproof/samplers/binary_search.h"

namespace lightproof {

/// The map with a sampler for each weighting. Refers to the map, which must outlive it.
class EnvironmentLight {
 public:
  explicit EnvironmentLight(const EnvironmentMap& map)
      : map_(&map), by_a_(map, {Weighting::A, kRec709}), by_b_(map, {Weighting::B, kRec709}) {}

  const EnvironmentMap& map() const { return *map_; }
  const BinarySearch& sampler(Weighting weighting) const {
    return weighting == Weighting::A ? by_a_ : by_b_;
  }

 private:
  const EnvironmentMap* map_;
  BinarySearch by_a_;
  BinarySearch by_b_;
};

}  // namespace lightproof
