// How a picture lies on the sphere: a drawing of a map in the convention of a preset, with its
// image coordinates, parallels and meridians, and where each axis points.
#pragma once

#include <array>
#include <string>

#include "lightproof/core/grid.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/warp/preset.h"

namespace lightproof {

/// The radiance of a map as pixels of a picture in the convention of a preset, row 0 at its top:
/// means of 4 x 4 look-ups a pixel. The map may have any mapping.
Grid<Rgb> picture_in_convention(const EnvironmentMap& map, Preset preset, Extent pixels);

/// An SVG document: the picture that picture_in_convention() makes, tone-mapped; image coordinates
/// u from the left and v from the top along its edges; parallels (theta from +z) and meridians (phi
/// from +x) every 30 degrees; Lightproof's axes, each where it points, with what it is called in
/// the frame of the preset's renderers: `their_axes` names Lightproof's +x, +y, +z there ("-X").
std::string map_drawing(const EnvironmentMap& map, Preset preset,
                        const std::array<std::string, 3>& their_axes);

}  // namespace lightproof
