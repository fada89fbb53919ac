// Colour profiles inside of picture files, of which the name matters.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace lightproof {

/// The description of an ICC profile (tag `desc`, of either version); "without a name" where it has
/// none. Source: ICC.1:2022, 9.2.41 and 10.15, and ICC.1:2001-04, 6.5.17.
std::string profile_name(std::span<const std::uint8_t> profile);

}  // namespace lightproof
