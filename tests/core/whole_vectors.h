// Whether vectors did what they should have done: results alone cannot tell where they are the same
// bits.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <string_view>

namespace lightproof {

/// Numbers in the widest vector (AVX-512).
inline constexpr std::size_t kWidestVector = 8;

/// Fails unless a loop that takes `step` numbers or fewer at a time has done all of `size` that
/// fill whole steps; on a processor without vectors, named SCALAR, unless it has done none.
inline void expect_whole_vectors(std::string_view vectors, std::size_t done, std::size_t size,
                                 std::size_t step = kWidestVector) {
  if (vectors == "SCALAR") {
    EXPECT_EQ(done, 0U);
    return;
  }
  EXPECT_LE(done, size);
  EXPECT_GT(done + step, size) << "of " << size;
}

}  // namespace lightproof
