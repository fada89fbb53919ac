// All point sets, in one table: the lists, the studies and the tests iterate over it. A new one is
// a header, a variant name and a row.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

#include "lightproof/points/hammersley.h"
#include "lightproof/points/metallic_lattice.h"
#include "lightproof/points/pcg3d.h"
#include "lightproof/points/philox_points.h"
#include "lightproof/points/point_set.h"
#include "lightproof/points/r2.h"
#include "lightproof/points/sine_hash.h"
#include "lightproof/points/sobol.h"
#include "lightproof/points/stratified.h"

namespace lightproof {

/// Visit once per batch, outside the loop.
using AnyPointSet =
    std::variant<PhiloxPoints, Pcg3dPoints<FrameIndex::whole>, Pcg3dPoints<FrameIndex::converted>,
                 Pcg3dPoints<FrameIndex::counted>, SineHashPoints, StratifiedPoints, Hammersley,
                 HammersleyFloat, MetallicLattice, MetallicLatticeFloat, R2, R2Float, Sobol>;

/// How the points of a set come about.
enum class PointKind {
  random,      ///< a generator of random numbers; independent
  hash,        ///< a hash of the index; meant to be independent
  stratified,  ///< random, one in each cell of a grid
  lattice,     ///< multiples of a vector, modulo 1
  net,         ///< one in each elementary interval in base 2
};

/// "random", "hash", "stratified", "lattice", "net".
std::string_view to_string(PointKind kind);

/// A row of the registry.
struct PointSetInfo {
  std::string_view name;         ///< "hammersley"
  std::string_view description;  ///< how its points come about
  std::string_view source;       ///< paper, book or lecture
  PointKind kind;
  /// Whether the set depends on its count, and has no points beyond; else the first n points are
  /// the set of n points.
  bool is_finite = false;
  bool is_float = false;         ///< computed in float, as shaders have it
  std::string_view defect = {};  ///< what is known to be wrong with it; empty if nothing
  AnyPointSet (*make)(std::uint64_t count, PointSeed seed) = nullptr;

  /// Makes the set of this many points; of a set without end, one that may be asked for any index.
  /// Throws InputError if the count is not in [1, 2^32].
  AnyPointSet prepare(std::uint64_t count, PointSeed seed = {}) const;
};

std::span<const PointSetInfo> point_sets();

/// Throws InputError, which lists the names, if there is none of this name.
const PointSetInfo& point_set_by_name(std::string_view name);

/// The point of this index.
SquarePoint point_of(const AnyPointSet& set, std::uint32_t index);

/// Writes the points first, first + 1, …, all of them below 2^32.
void fill_points(const AnyPointSet& set, std::uint64_t first, std::span<SquarePoint> points);

}  // namespace lightproof
