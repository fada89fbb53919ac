// What the gate found wrong, as files for whoever has to mend it.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "lightproof/report/result_folder.h"
#include "lightproof/results/gate_result.h"

namespace lightproof {

/// Writes for every rejection three files named SAMPLER-DENSITY-MAP:
///   …-residual.exr  (O - E) / sqrt(E) of the 32 x 16 bins over (phi, theta), zenith at the top
///   …-residual.png  the same in colours: red too many, blue too few, full at ten; 16 pixels a bin
///   ….json          diagnosis, worst 20 bins, divergence of the rows added up from t = 0, command
///                   to run it again
/// and the manifest. Makes the folder, even if there is nothing to write. Throws InputError if it
/// cannot be written, or if a file stands in the way that may not be overwritten.
void write_rejections(const GateResult& gate, const std::filesystem::path& folder,
                      const RunDescription& run = {},
                      Overwriting overwriting = Overwriting::refused);

/// The names of these files for one sampler on one map, whether it will be rejected or not.
std::set<std::string> rejection_file_names(const std::string& sampler,
                                           const std::string& density_space,
                                           const std::string& map);

}  // namespace lightproof
