// Whole numbers as people write them.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace lightproof::cli {

/// How whole_number() may be written, for a help text or a complaint.
inline constexpr std::string_view kWholeNumberForms =
    "also as 1e6, 64k, 4M, 2G (powers of 1000) or 2^22";

/// "4194304"; "1e6" and "2.5e3" if they are whole; "64k", "1.5M", "2G": k is 1000, M 1000^2, G
/// 1000^3; "2^22". None if it is anything else, or 2^64 and more.
std::optional<std::uint64_t> whole_number(std::string_view text);

/// In decimal digits only.
std::optional<std::uint64_t> whole_number_in_digits(std::string_view text);

}  // namespace lightproof::cli
