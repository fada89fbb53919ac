// Shares as text for terminals, with plain spaces.
#pragma once

#include <string>

namespace lightproof {

/// Two digits: "3.1 %", "12 %", "250 %"; "below 0.001 %" of what is less.
std::string plain_percent(double share);

}  // namespace lightproof
