// What the gate found wrong, as files for whoever has to mend it.
#pragma once

#include <filesystem>

#include "lightproof/suite/results.h"

namespace lightproof {

/// For every rejection three files named <sampler>-<weighting>-<map>:
///   …-residual.exr  (O - E) / sqrt(E) of the 32 x 16 bins over (phi, theta), zenith at the top
///   …-residual.png  the same in colours: red too many, blue too few, full at ten; 16 pixels a bin
///   ….json          diagnosis, worst 20 bins, divergence summed up by row, command to run it again
/// Makes the folder, even if there is nothing to write. Throws InputError if it cannot be written.
void write_rejections(const GateResult& gate, const std::filesystem::path& folder);

}  // namespace lightproof
