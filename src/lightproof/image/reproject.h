// From the pixels of a file, in the convention of a preset, to the texels of an EnvironmentMap.
#pragma once

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/warp/mapping.h"
#include "lightproof/warp/preset.h"

namespace lightproof {

/// Size in texels of the map that a picture of this size becomes: one column and row fewer for
/// node-centred presets, twice as wide for octahedral ones, else the same.
Extent map_extent(Preset preset, Extent picture);

/// The map (row 0 at t = 0) of a picture (row 0 at its top). Pixels that cover areas go to the
/// nearest texel: a permutation for lat-long presets. Nodes are interpolated bilinearly at the
/// texel centres.
Grid<Rgb> map_from_picture(Preset preset, const Grid<Rgb>& picture);

/// The texels that the pixels of a picture are.
struct OwnTexels {
  Mapping mapping;
  Extent extent;
};

/// The texels that the pixels of a picture of this size are: nodes are texels around them, of which
/// the last column is the first; the faces of a cube stand side by side. Presets that turn an odd
/// number of columns by half a turn shift the mapping by half a texel.
OwnTexels own_texels(Preset preset, Extent picture);

/// The pixels of a picture (row 0 at its top) as texels of own_texels(), row 0 at the bottom. None
/// is changed.
Grid<Rgb> own_texels_of(Preset preset, const Grid<Rgb>& picture);

/// Column and row of a picture, from its top left.
struct PicturePixel {
  int column = 0;
  int row = 0;
};

/// The pixel of a picture that holds, or for nodes is nearest to, the centre of texel
/// (column, row) of the map that it becomes.
PicturePixel pixel_in_picture(Preset preset, Extent picture, int column, int row);

/// The pixel of a picture that is texel (column, row) of own_texels().
PicturePixel own_pixel_in_picture(Preset preset, Extent picture, int column, int row);

}  // namespace lightproof
