// How decoders say that a file cannot be read. What else escapes them is reported in the same way.
#pragma once

#include <string>

#include "lightproof/core/error.h"

namespace lightproof {

/// Refuses the file: throws InputError. The reason is complete, but for the file's name.
[[noreturn]] inline void refuse(const std::string& reason) { throw InputError(reason); }

}  // namespace lightproof
