// Pictures as files in memory, by lightproof-decode. Private to the image module. The file itself
// is then written by write_file(), which notices a full disk.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "lightproof/core/grid.h"
#include "lightproof/image/decoder_messages.h"

namespace lightproof {

inline LevelSize size_of(Extent extent) { return {extent.width, extent.height}; }

/// The bytes of the file that `request` describes. `samples_of(level)` is asked for one level after
/// the other, and its samples need to live until the next call. Throws InputError.
std::string encode(EncodeRequest request,
                   const std::function<std::span<const std::byte>(int)>& samples_of);

}  // namespace lightproof
