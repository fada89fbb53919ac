// What maps that are computed beforehand give at a shading point, from the light that they are
// computed of: by how much such look-ups are biased.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "lightproof/materials/material.h"
#include "lightproof/recommend/scattered_light.h"

namespace lightproof {

/// The luminance that an estimator finds.
struct LookedUpLight {
  std::string_view estimator;
  double luminance;
};

/// The look-ups of a material under one map, which must outlive it: sh-9 and tabulated irradiance
/// of Lambert's, prefiltered phong of Phong's, the split sum of GGX.
class PredictedLookUps {
 public:
  PredictedLookUps(const MapSummary& summary, const Material& material);

  /// What each of them gives at a point, whose light reaches all that is seen along `axis`, the
  /// mirrored view.
  std::vector<LookedUpLight> at(const ScatteredLight& light, const ShadingPoint& at,
                                Direction axis) const;

 private:
  /// A level of the split sum's chain.
  struct Level {
    Extent extent;
    double share;             ///< of the look-up
    std::optional<Ggx> lobe;  ///< none: the mirror
    double norm = 0.0;        ///< ∫ of the density with which normals are drawn times the cosine
  };

  void set_chain(const Ggx& ggx);
  double of_level(const Level& level, const ScatteredLight& light, Direction axis) const;

  const MapSummary* summary_;
  Material material_;
  std::vector<Level> chain_;
};

}  // namespace lightproof
