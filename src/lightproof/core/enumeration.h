// What must be known of an enumeration to tell whether a number is one of its values.
#pragma once

#include <cstddef>

namespace lightproof {

/// How many values an enumeration has, which count from 0. Specialised beside the enumeration.
template <class Enumeration>
inline constexpr std::size_t kValuesOf = 0;

}  // namespace lightproof
