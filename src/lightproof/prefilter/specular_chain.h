// A chain of prefiltered maps as an engine loads it into the levels of one texture: level 0 is the
// mirror, every further one is rougher and half as large; between levels the look-up interpolates.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/prefilter/prefilter.h"

namespace lightproof {

/// Level by level, the finest first.
using SpecularChain = std::vector<Grid<Rgb>>;

/// Sizes of the levels, each half of the one before, rounded down, at least 1. Throws InputError if
/// the size is not positive or has not so many levels.
std::vector<Extent> level_extents(Extent extent, int levels);

/// Perceptual roughness of the levels: i/(levels - 1), and 0 of a single one.
std::vector<double> level_roughness(int levels);

/// Throws InputError unless the roughness is in [0,1].
void check_roughness(double roughness);

/// What prefilters a level of this perceptual roughness: GGX with alpha = R^2; none for the mirror
/// at R = 0. Throws InputError unless the roughness is in [0,1].
std::optional<Lobe> ggx_lobe(double roughness, GgxWeight weight = GgxWeight::cosine,
                             double f0 = 1.0);

/// A chain of GGX levels of level_roughness(levels), from `extent` down.
SpecularChain ggx_chain(const Grid<Rgb>& map, Extent extent, int levels,
                        GgxWeight weight = GgxWeight::cosine,
                        const PrefilterSettings& settings = {});

/// The direction that a level of a Phong chain is looked up with.
enum class PhongAxis {
  reflection,  ///< the mirrored view alone: (n+1)/2pi cos^n
  all_one,     ///< normal and view too: (n+2)/2pi cos^(n+1), the receiver's cosine in it
};

/// A chain of one Phong exponent a level, from `extent` down; no level is a mirror. Throws
/// InputError if an exponent is negative or not finite.
SpecularChain phong_chain(const Grid<Rgb>& map, Extent extent, std::span<const double> exponents,
                          PhongAxis axis = PhongAxis::reflection,
                          const PrefilterSettings& settings = {});

/// The level to look up for a roughness, in a chain of GGX levels: R (levels - 1).
constexpr double level_of_roughness(double roughness, int levels) {
  return roughness * (levels - 1);
}

/// As published in the lecture's shader: R mipCount, which lies beyond the last level at R = 1, and
/// between the right ones everywhere else.
constexpr double level_of_roughness_published(double roughness, int levels) {
  return roughness * levels;
}

/// Interpolated bilinearly in the levels beside `level`, and linearly between them; clamped to the
/// levels that there are.
Rgb look_up(const SpecularChain& chain, Direction direction, double level);

}  // namespace lightproof
