#include "lightproof/image/lat_long_texels.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "lightproof/core/error.h"
#include "lightproof/core/temporary_folder.h"
#include "lightproof/image/reader.h"
#include "lightproof/image/synthetic.h"
#include "tests/image/picture_files.h"

namespace lightproof {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A picture for every preset: odd widths where columns can be shifted.
Extent picture_for(const PresetInfo& preset) {
  if (preset.aspect == 1.0) return {9, 9};
  if (preset.aspect == 6.0) return {24, 4};
  return {15, 8};
}

// The same texels as those of a reader that resamples: both go through the picture.
TEST(LatLongTexels, AreThoseOfAReaderThatResamples) {
  const TemporaryFolder folder;
  for (const PresetInfo& preset : presets()) {
    SCOPED_TRACE(preset.name);
    const Extent extent = picture_for(preset);
    Grid<Rgb> picture = test::numbered_picture(extent);
    // The first and the last column of nodes are one.
    if (preset.lattice == Lattice::node_centred) {
      for (int y = 0; y < extent.height; ++y) picture(extent.width - 1, y) = picture(0, y);
    }
    test::write_exr_file(folder / "a.exr", picture);
    ReadOptions options{.preset = preset.preset, .any_aspect = true};
    const EnvironmentMap own = read_environment_map(folder / "a.exr", options);
    options.resample = true;
    const EnvironmentMap expected = read_environment_map(folder / "a.exr", options);
    const EnvironmentMap found = resampled_to_lat_long(own);
    EXPECT_TRUE(is_plain(found.mapping));
    EXPECT_EQ(found.radiance.extent(), expected.radiance.extent());
    EXPECT_TRUE(std::ranges::equal(found.radiance.values(), expected.radiance.values()));
    EXPECT_EQ(found.notes.size(), own.notes.size() + (is_plain(own.mapping) ? 0 : 1));
    EXPECT_NO_THROW(require_lat_long(found, "irradiance"));
  }
}

TEST(LatLongTexels, AreAskedForWithTheMapItsMappingAndAWayOut) {
  const EnvironmentMap map = make_synthetic_map("constant", {24, 4}, {MappingKind::cube_strip});
  EXPECT_THAT([&] { require_lat_long(map, "irradiance"); },
              testing::ThrowsMessage<InputError>(AllOf(HasSubstr("constant: its texels are cube"),
                                                       HasSubstr("irradiance needs"),
                                                       HasSubstr("--resample"))));
  EXPECT_NO_THROW(require_lat_long(make_synthetic_map("constant", {8, 4}), "irradiance"));
}

}  // namespace
}  // namespace lightproof
