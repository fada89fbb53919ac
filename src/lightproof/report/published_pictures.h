// Pictures of what published forms get wrong.
#pragma once

#include <string>
#include <vector>

#include "lightproof/results/published_picture.h"

namespace lightproof {

/// Each exact picture beside the published and the corrected one with their signed differences.
std::string published_pictures_html(const std::vector<PublishedPicture>& pictures);

}  // namespace lightproof
