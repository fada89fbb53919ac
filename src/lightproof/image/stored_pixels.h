// From the samples that lightproof-decode sends to a picture of linear RGB. Private to the image
// module.
#pragma once

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/image/decoder.h"
#include "lightproof/image/picture_header.h"
#include "lightproof/image/stored_picture.h"

namespace lightproof {

/// The order in which a picture's lines come: that of the format, or that of Exif.
StoredOrder order_of(const StoredPicture& stored);

/// Receives the samples that were asked for, of `channels` (1 or 3) a pixel, as a picture of its
/// display window: row 0 at the top, what is encoded decoded, CIE XYZ as RGB of Rec. 709. Throws
/// InputError.
Grid<Rgb> receive_pixels(Decoder& decoder, const StoredPicture& stored, int channels);

}  // namespace lightproof
