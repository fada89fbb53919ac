// Pictures of a receiver.
#pragma once

#include <cstdint>

#include "lightproof/core/grid.h"
#include "lightproof/render/direct_lighting.h"
#include "lightproof/render/receiver.h"

namespace lightproof {

/// The mean of `samples` estimates per pixel; pixels beside the receiver show the map itself. Row 0
/// at the top. The same bits for any number of threads.
Grid<Rgb> render_picture(const Lighting& lighting, const ReceiverInfo& receiver, Extent picture,
                         std::uint64_t samples, const RandomStream& stream);

}  // namespace lightproof
