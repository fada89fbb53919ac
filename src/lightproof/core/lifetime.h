// The same bytes as objects of another type, without undefined behaviour and without a copy.
#pragma once

#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>

namespace lightproof {

/// Objects of type T in these bytes, with the values that the bytes have as such; what was there
/// before ends. What std::start_lifetime_as_array of C++23 does: memmove() begins the objects that
/// are used afterwards (P0593, part of C++20), and compilers leave out one that moves nothing.
template <class T>
T* start_lifetime_as_array(void* memory, std::size_t bytes) {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
  return std::launder(static_cast<T*>(std::memmove(memory, memory, bytes)));
}

}  // namespace lightproof
