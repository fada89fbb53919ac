#include "lightproof/image/radiance_writer.h"

#include <span>

#include "lightproof/image/encoder.h"

namespace lightproof {

std::string radiance_bytes(const Grid<Rgb>& picture, const Attributes& attributes,
                           const std::optional<Chromaticities>& chromaticities) {
  return encode({.format = PictureFormat::radiance,
                 .channels = {"R", "G", "B"},
                 .levels = {size_of(picture.extent())},
                 .attributes = attributes,
                 .chromaticities = chromaticities},
                [&](int /*level*/) { return std::as_bytes(picture.values()); });
}

}  // namespace lightproof
