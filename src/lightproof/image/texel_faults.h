// Texel values that no radiance can have: where they are, and how they are repaired.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"

namespace lightproof {

/// Texels with at least one value of a kind; the first in reading order, counted from 0 at the top
/// left of the picture.
struct TexelFault {
  std::string_view kind;
  std::size_t count = 0;
  int column = 0;
  int row = 0;
};

struct TexelScan {
  std::array<TexelFault, 3> faults;
  /// The largest finite value of any channel; 0 if there is no positive one.
  float brightest = 0.0F;

  bool clean() const;
};

TexelScan scan_texels(const Grid<Rgb>& picture);

/// "2 texels with negative values (the first at column 5, row 2), 1 texel with NaN (…)".
std::string describe_faults(const TexelScan& scan);

/// Sets every negative, NaN or infinite value to 0; the other channels of the texel stay.
void repair_texels(Grid<Rgb>& picture);

}  // namespace lightproof
