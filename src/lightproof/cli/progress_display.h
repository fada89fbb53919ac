// How far the work is, on stderr.
#pragma once

#include <chrono>

#include "lightproof/core/progress.h"

namespace lightproof::cli {

/// On a terminal a bar, which is wiped when the last copy of the function goes: before anything is
/// printed. Elsewhere a plain line every `interval`, "gate: 40 %, 2 min 5 s left", and, where there
/// are several steps, one at the end of each that took a second or more, "gate: done in 52.1 s".
/// An interval of 0: none.
Progress progress_display(std::chrono::seconds interval);

}  // namespace lightproof::cli
