// Many points of a stream at once, with vectors: the same bits as RandomStream::point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "lightproof/core/random.h"

namespace lightproof {

/// Writes the points first, first + 1, … of the stream: s[i] and t[i]. Both spans are of one size.
/// Returns how many points vectors drew: 0 on a processor without vectors.
std::size_t fill_points(const RandomStream& stream, std::uint64_t first, std::span<double> s,
                        std::span<double> t);

/// The same, point by point.
std::size_t fill_points(const RandomStream& stream, std::uint64_t first,
                        std::span<SquarePoint> points);

}  // namespace lightproof
