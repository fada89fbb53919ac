// Where measurements of this program are kept.
#pragma once

#include <filesystem>
#include <string>

#include "lightproof/core/kept_measurement.h"

namespace lightproof::cli {

/// Where measurements are kept, as in ci/lib.sh; empty if there is no place for them.
std::filesystem::path cache_folder();

/// What is kept of this program.
MeasurementCache kept_measurements(std::string commit, bool measure_again);

}  // namespace lightproof::cli
