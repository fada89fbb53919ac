// Where a material's lobe is, and how narrow: where integrals over directions need many nodes.
#pragma once

#include "lightproof/materials/material.h"

namespace lightproof {

/// The place in which a material's k varies fast: around the mirrored view.
struct LobeExtent {
  Direction axis;
  double width;  ///< in radians; infinite if there is no lobe

  /// Whether k may vary by much within the cap of this angle, in radians, around a direction: if
  /// the cap is wider than a third of the lobe, or of its distance from the lobe's axis, where the
  /// lobe's tails are as wide as they are far.
  bool varies_within(Direction direction, double angle) const;
};

/// The lobe of a material at a shading point.
LobeExtent lobe_at(const Material& material, const ShadingPoint& at);

}  // namespace lightproof
