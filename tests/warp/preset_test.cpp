#include "lightproof/warp/preset.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lightproof/core/random.h"
#include "tests/warp/published_mapping.h"

namespace lightproof {
namespace {

// Each image coordinate carries at most 6 roundings of 2^-53, pulled below 1 included; no mapping
// stretches by more than 2 pi = 6.3 (lat-long) or 8 (octahedral) per unit; the trigonometry adds 4.
constexpr double kTolerance = 6e-15;

std::vector<Direction> random_directions() {
  std::vector<Direction> directions;
  const RandomStream stream("preset", 1);
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const SquarePoint u = stream.point(i);
    const double z = 1.0 - 2.0 * u.s;
    const double sine = std::sqrt(1.0 - z * z);
    const double phi = 2.0 * kPi * u.t;
    directions.push_back(glm::normalize(Direction(sine * std::cos(phi), sine * std::sin(phi), z)));
  }
  return directions;
}

/// Axes, both sides of every seam, and what lies beside the poles.
std::vector<Direction> special_directions() {
  std::vector<Direction> directions;
  for (const double sign : {1.0, -1.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double aside : {0.0, -0.0, 1e-300, -1e-300, 1e-17, -1e-17, 1e-9, -1e-9}) {
        Direction d(0.0);
        d[axis] = sign;
        d[(axis + 1) % 3] = aside;
        directions.push_back(glm::normalize(d));
      }
    }
  }
  return directions;
}

class EveryPreset : public testing::TestWithParam<Preset> {
 protected:
  const PresetInfo& preset() const { return info(GetParam()); }

  void expect_round_trip(Direction d) const {
    const SquarePoint at = image_from_direction(GetParam(), d);
    const double limit = preset().lattice == Lattice::node_centred ? 1.0 : 0x1.fffffffffffffp-1;
    EXPECT_GE(at.s, 0.0);
    EXPECT_LE(at.s, limit);
    EXPECT_GE(at.t, 0.0);
    EXPECT_LE(at.t, limit);
    EXPECT_LT(glm::length(direction_from_image(GetParam(), at) - d), kTolerance)
        << d.x << ' ' << d.y << ' ' << d.z << " at " << at.s << ' ' << at.t;
  }
};

TEST_P(EveryPreset, ReturnsRandomDirections) {
  for (const Direction d : random_directions()) expect_round_trip(d);
}

TEST_P(EveryPreset, ReturnsAxesSeamsAndPoles) {
  for (const Direction d : special_directions()) expect_round_trip(d);
}

TEST_P(EveryPreset, ReturnsImagePoints) {
  const RandomStream stream("preset-image", 1);
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const SquarePoint at = stream.point(i);
    const SquarePoint back = image_from_direction(GetParam(), direction_from_image(GetParam(), at));
    // Next to a pole s is worth 1/sin(theta) roundings; 1e-10 covers the closest of these points.
    EXPECT_NEAR(back.s, at.s, 1e-10);
    EXPECT_NEAR(back.t, at.t, 1e-10);
  }
}

// acos and asin, as printed, lose half of the digits near a pole: 1e-7 is their share, and a wrong
// axis or sign is off by tenths.
TEST_P(EveryPreset, FollowsThePublishedFormula) {
  for (const Direction d : random_directions()) {
    const SquarePoint at = image_from_direction(GetParam(), d);
    const test::PublishedPoint expected = test::published_mapping(GetParam(), d);
    EXPECT_NEAR(at.s, expected.u, 1e-7);
    EXPECT_NEAR(at.t, 1.0 - expected.v, 1e-7);
  }
}

TEST_P(EveryPreset, IsFoundByItsName) {
  EXPECT_EQ(preset().preset, GetParam());
  EXPECT_EQ(preset_by_name(preset().name), GetParam());
  EXPECT_FALSE(preset().description.empty());
}

std::vector<Preset> all_presets() {
  std::vector<Preset> all;
  for (const PresetInfo& row : presets()) all.push_back(row.preset);
  return all;
}

std::string test_name(const testing::TestParamInfo<Preset>& parameter) {
  std::string name(info(parameter.param).name);
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Presets, EveryPreset, testing::ValuesIn(all_presets()), test_name);

struct KnownDirection {
  Preset preset;
  Direction direction;
  SquarePoint image;  ///< t from the bottom
};

// By hand from the renderers' documentation; directions in the world with z up.
const KnownDirection kKnown[] = {
    {Preset::z_up, {1, 0, 0}, {0.5, 0.5}},
    {Preset::z_up, {0, 1, 0}, {0.25, 0.5}},
    {Preset::z_up, {-1, 0, 0}, {0.0, 0.5}},
    {Preset::z_up, {0, -1, 0}, {0.75, 0.5}},
    {Preset::z_up, {0, 0, -1}, {0.5, 0.0}},
    {Preset::z_up_half_turn, {1, 0, 0}, {0.0, 0.5}},
    {Preset::z_up_half_turn, {0, 1, 0}, {0.75, 0.5}},
    {Preset::z_up_half_turn, {-1, 0, 0}, {0.5, 0.5}},
    {Preset::z_up_half_turn, {0, -1, 0}, {0.25, 0.5}},
    {Preset::openexr, {1, 0, 0}, {0.5, 0.5}},   // Z: lon 0
    {Preset::openexr, {0, 1, 0}, {0.25, 0.5}},  // X: lon pi/2
    {Preset::openexr, {0, 0, 1}, {0.5, 1.0}},   // Y: lat pi/2, the top row
    {Preset::exr_area, {0, 1, 0}, {0.25, 0.5}},
    {Preset::exr_area, {0, -1, 0}, {0.75, 0.5}},
    {Preset::pbrt_v3, {1, 0, 0}, {0.0, 0.5}},
    {Preset::pbrt_v3, {0, 1, 0}, {0.25, 0.5}},
    {Preset::pbrt_v3, {-1, 0, 0}, {0.5, 0.5}},
    {Preset::pbrt_v3, {0, -1, 0}, {0.75, 0.5}},
    {Preset::pbrt_v4, {0, 0, 1}, {0.5, 0.5}},
    {Preset::pbrt_v4, {1, 0, 0}, {1.0, 0.5}},
    {Preset::pbrt_v4, {0, 1, 0}, {0.5, 0.0}},  // v = 1, the bottom
    {Preset::pbrt_v4, {0, -1, 0}, {0.5, 1.0}},
    {Preset::mitsuba, {-1, 0, 0}, {0.0, 0.5}},  // -Z: u = 0
    {Preset::mitsuba, {0, 1, 0}, {0.25, 0.5}},  // X: u = 1/4
    {Preset::mitsuba, {1, 0, 0}, {0.5, 0.5}},
    {Preset::mitsuba, {0, -1, 0}, {0.75, 0.5}},
    {Preset::cube, {1, 0, 0}, {1.5 / 6, 0.5}},  // the middle of -X
    {Preset::cube, {0, 0, 1}, {2.5 / 6, 0.5}},  // of +Y
    {Preset::cube, {0, 1, 0}, {5.5 / 6, 0.5}},  // of -Z
};

TEST(Preset, PlacesTheKnownDirections) {
  for (const KnownDirection& known : kKnown) {
    const SquarePoint at = image_from_direction(known.preset, known.direction);
    // One rounding of atan2 over pi, or pulled below 1.
    EXPECT_NEAR(at.s, known.image.s, 2e-16) << info(known.preset).name;
    EXPECT_NEAR(at.t, known.image.t, 2e-16) << info(known.preset).name;
  }
}

TEST(Preset, HasNoOtherNames) {
  EXPECT_EQ(preset_by_name("z-down"), std::nullopt);
  EXPECT_EQ(preset_by_name(""), std::nullopt);
  EXPECT_EQ(presets().size(), 8U);
}

}  // namespace
}  // namespace lightproof
