// The BRDF integration map of the split-sum approximation (Karis 2013, "Real Shading in Unreal
// Engine 4"): what scales and what is added to the reflectance at normal incidence.
#pragma once

#include <glm/vec2.hpp>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/image/attribute.h"

namespace lightproof {

/// (A, B) of the directional albedo F0 A + B, over the cosine n.v between normal and view (columns,
/// from the left: (column + 1/2) / width) and roughness (rows, from the top: (row + 1/2) / height).
/// A texture look-up at (n.v, roughness) whose origin is the top left finds them.
struct BrdfMap {
  Grid<glm::vec2> values;
  Attributes attributes = {};
};

/// What a file says of the map, before its own attributes.
Attributes attributes_of(const BrdfMap& map);

/// For looking at: A in red, B in green, no blue; values as they are.
Grid<Rgb> picture_of(const BrdfMap& map);

}  // namespace lightproof
