// Texel values that no radiance can have: where they are, and how they are repaired.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"

namespace lightproof {

/// The kind of fault that +Inf and -Inf are.
inline constexpr std::string_view kInfiniteValues = "infinite values";

/// Texels with at least one value of a kind; the first in reading order, counted from 0 at the top
/// left of the picture.
struct TexelFault {
  std::string_view kind;
  std::size_t count = 0;
  int column = 0;
  int row = 0;
};

/// The texels of a picture that no radiance can have, by kind.
struct TexelScan {
  std::array<TexelFault, 3> faults;
  /// The largest finite value of any channel; 0 if there is no positive one.
  float brightest = 0.0F;

  bool clean() const;
  /// How many texels have a fault of this kind.
  std::size_t count_of(std::string_view kind) const;
};

/// Looks through a picture, row 0 at the top, for values that no radiance can have.
TexelScan scan_texels(const Grid<Rgb>& picture);

/// A fault in words: "2 texels with negative values (the first at column 5, row 2)".
std::string describe_fault(const TexelFault& fault);

/// All faults of a scan in words: "2 texels with negative values (…), 1 texel with NaN (…)".
std::string describe_faults(const TexelScan& scan);

/// What becomes of values that no radiance can have.
enum class Repair {
  refuse,  ///< the file is not read
  zero,    ///< each is set to 0
  clamp,   ///< +Inf becomes the largest finite value of the picture, each other one 0
};

/// Replaces every value that no radiance can have by 0, and +Inf by `infinite`; the other channels
/// of the texel stay.
void repair_texels(Grid<Rgb>& picture, float infinite);

/// A picture that is 1 in the channels that are +Inf, and else 0: what repair_texels() makes
/// bright.
Grid<Rgb> infinite_channels(const Grid<Rgb>& picture);

}  // namespace lightproof
