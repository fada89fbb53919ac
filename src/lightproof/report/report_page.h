// The whole page.
#pragma once

#include <string>

#include "lightproof/results/study_result.h"

namespace lightproof {

/// A study as one HTML document that needs nothing else: pictures, charts and the code that draws
/// them are inside, and it opens from a disk without a network.
std::string report_page(const StudyResult& study);

/// A page of what hard inputs made of methods alone.
std::string stability_page(const StabilityResult& stability, const std::string& version);

}  // namespace lightproof
