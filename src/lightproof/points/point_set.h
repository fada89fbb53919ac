// What a point set of the unit square is: a value that gives every point by its index.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>

#include "lightproof/core/measure.h"

namespace lightproof {

/// Indices of points lie in [0, 2^32), as those of samples and frames do on a graphics processor.
inline constexpr std::uint64_t kMostPoints = std::uint64_t{1} << 32U;

/// Point sets are immutable, and many threads may ask them. All coordinates are in [0,1), except
/// where a row of the registry names the defect.
template <class Set>
concept PointSet = requires(const Set& set, std::uint32_t index) {
  { set.point(index) } -> std::same_as<SquarePoint>;
};

/// What makes a point set random, so that means over it are unbiased and independent between seeds:
/// it shifts a lattice by a random vector modulo 1 (Cranley and Patterson 1976), scrambles a net
/// (Owen 1995), keys a hash or a generator. Without a seed a point set is as its source has it; a
/// hash or generator has the seed 0 then.
using PointSeed = std::optional<std::uint64_t>;

}  // namespace lightproof
