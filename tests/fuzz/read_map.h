// Reads a file in all the ways in which it may be read.
#pragma once

#include <filesystem>

#include "tests/fuzz/fuzz.h"

namespace lightproof::fuzz {

/// Reads a map from a file and looks at it, by options that `choice` chooses. Fails if a map that
/// was accepted is none: a size, a value or a luminance that no map can have.
void read_map(const std::filesystem::path& file, Input choice);

}  // namespace lightproof::fuzz
