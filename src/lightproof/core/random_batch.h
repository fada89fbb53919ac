// Many points of a stream at once, with vectors: the same bits as RandomStream::point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "lightproof/core/random.h"

namespace lightproof {

/// Writes the points first, first + 1, … of the stream as two arrays of one size: s[i] and t[i].
/// Returns how many of them vectors drew: 0 on a processor without vectors.
std::size_t fill_points(const RandomStream& stream, std::uint64_t first, std::span<double> s,
                        std::span<double> t);

/// Writes the points first, first + 1, … of the stream. Returns how many of them vectors drew: 0 on
/// a processor without vectors.
std::size_t fill_points(const RandomStream& stream, std::uint64_t first,
                        std::span<SquarePoint> points);

}  // namespace lightproof
