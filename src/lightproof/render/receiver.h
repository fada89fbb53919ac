// What is lit: a point with a normal, a sphere, a plane, or a sphere on a plane, seen by a camera.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "lightproof/core/grid.h"
#include "lightproof/materials/shading_point.h"
#include "lightproof/render/scene.h"

namespace lightproof {

/// A receiver, and what it is made of.
struct ReceiverInfo {
  std::string_view name;
  std::string_view description;
  SceneContent content;
  bool occluded;  ///< whether some of its points do not see their whole hemisphere
};

/// All receivers: point, sphere, plane, sphere-on-plane.
std::span<const ReceiverInfo> receivers();

/// The receiver of this name. Throws InputError listing the names if there is none.
const ReceiverInfo& receiver_by_name(std::string_view name);

/// A pixel (column, row from the top) and the point that its centre shows.
struct Pixel {
  int x;
  int y;
  ShadingPoint point;
};

/// The unit direction from the eye through the centre of a pixel.
Direction camera_ray(int x, int y, Extent picture);

/// The pixels of a picture of this size that show the receiver, row by row. The point receiver
/// has a single one, at (0, 0), with its normal along +z and seen at 45 degrees.
std::vector<Pixel> visible_pixels(const ReceiverInfo& receiver, const Scene& scene, Extent picture);

/// Whether the cap of this angle (radians) around the direction may straddle the point's horizon
/// or the outline of something that blocks its light.
bool straddles_edge(const ReceiverInfo& receiver, const ShadingPoint& point, Direction direction,
                    double angle);

}  // namespace lightproof
