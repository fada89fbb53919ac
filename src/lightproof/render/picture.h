// Pictures of a receiver.
#pragma once

#include <functional>

#include "lightproof/core/grid.h"
#include "lightproof/core/random.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/render/receiver.h"

namespace lightproof {

/// The radiance that a point reflects to the camera, by the points of a stream of its own.
using Shade = std::function<Rgb(const ShadingPoint& at, const RandomStream& stream)>;

/// A picture of a receiver, row 0 at the top: `shade` at every pixel that shows it; the others show
/// the map itself. The number of threads changes no bit.
Grid<Rgb> render_picture(const EnvironmentMap& map, const Scene& scene,
                         const ReceiverInfo& receiver, Extent picture, const RandomStream& stream,
                         const Shade& shade);

}  // namespace lightproof
