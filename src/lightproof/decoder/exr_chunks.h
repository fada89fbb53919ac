// Chunks of OpenEXR files that hold less than their pixels need. OpenEXR 3.1 takes such a chunk if
// it is not compressed, or by RLE or ZIP, and shows in the place of what is missing what was in its
// memory before. The other compressions notice it themselves.
#pragma once

#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfTileDescription.h>

#include <optional>

namespace lightproof {

/// The tiles of a part that is stored in tiles; a part of lines may have the attribute, too, of any
/// size, which means nothing.
std::optional<Imf::TileDescription> tiles_of(const Imf::Header& header);

/// From now on ZIP chunks that do not hold as much as one of this part must, do not decompress.
void expect_chunks_of(const Imf::Header& header);

/// Refuses uncompressed chunks, and those by RLE, of the lines [first, last) that do not hold as
/// much as they must: throws InputError. Files of tiles are looked at as a whole where `first` is
/// their first line. Nothing is done for other compressions.
void check_chunks(Imf::InputPart& part, int first, int last);

}  // namespace lightproof
