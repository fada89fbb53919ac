#include "lightproof/study/study.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {

// The light of a constant map is that of its resampled one; points drawn from it are points of the
// picture, whose texels are those of latitude and longitude.
TEST(DescribeMap, ShowsItInLatitudeAndLongitudeAndTellsItsOwnTexels) {
  const EnvironmentMap cube = make_synthetic_map("constant", {48, 8}, {MappingKind::cube_strip});
  const MapRecord record = describe_map(cube, 1);
  EXPECT_EQ(record.own_mapping, cube.mapping);
  EXPECT_EQ(record.own_texels, (Extent{48, 8}));
  EXPECT_EQ(record.map.mapping, Mapping{});
  EXPECT_EQ(record.map.radiance.extent(), (Extent{32, 16}));
  EXPECT_NEAR(record.effective_fraction, 1.0, 1e-12);
  EXPECT_FALSE(record.drawn.empty());

  const EnvironmentMap plain = make_synthetic_map("constant", {32, 16});
  EXPECT_EQ(describe_map(plain, 1).own_texels, (Extent{32, 16}));
  EXPECT_TRUE(describe_map(plain, 1).map.notes.empty());
}

}  // namespace
}  // namespace lightproof
