// Where a material's lobe is, and how narrow: where integrals over directions need many nodes.
#pragma once

#include "lightproof/materials/material.h"

namespace lightproof {

/// The place in which a material's k varies fast: around the mirrored view.
struct LobeExtent {
  Direction axis;
  double width;  ///< in radians; infinite if there is no lobe

  /// Whether k may vary by much within the cap of this angle, in radians, around a direction: if
  /// the cap is wider than a sixth of the lobe, or of its distance from the lobe's axis, where the
  /// lobe's tails are as wide as they are far. (Where the view grazes, tails are narrower across:
  /// with a third, GGX of roughness 0.1 seen at 83 degrees was off by 3e-3 of its albedo, with a
  /// sixth by 5e-5.)
  bool varies_within(Direction direction, double angle) const;
};

/// The lobe of a material at a shading point.
LobeExtent lobe_at(const Material& material, const ShadingPoint& at);

}  // namespace lightproof
