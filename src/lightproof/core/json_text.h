// What is known of a JSON text before it is parsed.
#pragma once

#include <cstddef>
#include <string_view>

namespace lightproof {

/// How many arrays and objects of a JSON text lie inside each other at most; of a text that is no
/// JSON, any number.
std::size_t json_depth(std::string_view text);

/// No file that is read here needs more. Values are copied and printed by functions that call
/// themselves: a text of a million brackets would overflow the stack.
inline constexpr std::size_t kDeepestJson = 64;

}  // namespace lightproof
