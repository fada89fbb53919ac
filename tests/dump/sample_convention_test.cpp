#include "lightproof/dump/sample_convention.h"

#include <gmock/gmock.h>

#include <set>

#include "lightproof/core/error.h"
#include "lightproof/warp/cube.h"

namespace lightproof {
namespace {

const Direction kOblique = {0.48, -0.6, 0.64};

TEST(AxisMap, TakesEachOfOurAxesFromTheirs) {
  const Direction ours = AxisMap::parse("x,-z,y")(kOblique);
  EXPECT_EQ(ours, Direction(0.48, -0.64, -0.6));
  EXPECT_EQ(AxisMap()(kOblique), kOblique);
}

TEST(AxisMap, AfterAnotherIsBothInTurn) {
  for (const AxisMap& first : AxisMap::all()) {
    for (const AxisMap& second : AxisMap::all()) {
      EXPECT_EQ(second.after(first)(kOblique), second(first(kOblique)))
          << first.text() << " then " << second.text();
    }
  }
}

TEST(AxisMap, AfterItsInverseIsNone) {
  for (const AxisMap& map : AxisMap::all()) {
    EXPECT_EQ(map.after(map.inverse()), AxisMap()) << map.text();
    EXPECT_EQ(map.inverse().after(map), AxisMap()) << map.text();
  }
}

TEST(AxisMap, AreFortyEightOfWhichHalfMirror) {
  std::set<std::string> texts;
  int mirrors = 0;
  for (const AxisMap& map : AxisMap::all()) {
    texts.insert(map.text());
    mirrors += map.mirrors() ? 1 : 0;
    EXPECT_EQ(AxisMap::parse(map.text()), map);
    // The determinant of what it does to the axes.
    const Direction x = map({1, 0, 0});
    const Direction y = map({0, 1, 0});
    const Direction z = map({0, 0, 1});
    EXPECT_EQ(glm::dot(glm::cross(x, y), z) < 0.0, map.mirrors()) << map.text();
  }
  EXPECT_EQ(texts.size(), 48U);
  EXPECT_EQ(mirrors, 24);
  EXPECT_EQ(AxisMap::all().front(), AxisMap());
}

TEST(AxisMap, IsRefusedUnlessEachAxisIsThereOnce) {
  for (const char* text : {"", "x,y", "x,y,y", "x,y,w", "x,y,z,", "x y z", "--x,y,z"}) {
    EXPECT_THROW(AxisMap::parse(text), InputError) << text;
  }
}

// preset.h: with (X, Y, Z) = (y, z, x) the presets with y up are `z-up`.
TEST(AxesOfAPreset, TakeItsUpToOurs) {
  const Direction up_of_mitsuba = {0.0, 1.0, 0.0};
  EXPECT_EQ(axes_of(Preset::mitsuba)(up_of_mitsuba), Direction(0.0, 0.0, 1.0));
  const Direction their_z = {0.0, 0.0, 1.0};
  EXPECT_EQ(axes_of(Preset::openexr)(their_z), Direction(1.0, 0.0, 0.0));
  EXPECT_EQ(axes_of(Preset::pbrt_v4), AxisMap());
  // Graphics libraries look cube maps up in left-handed axes; all others are right-handed.
  for (const PresetInfo& preset : presets()) {
    EXPECT_EQ(axes_of(preset.preset).mirrors(), preset.preset == Preset::cube) << preset.name;
  }
  const Direction at = {0.48, -0.6, 0.64};
  EXPECT_EQ(axes_of(Preset::cube)(cube_axes_from_world(at)), at);
}

}  // namespace
}  // namespace lightproof
