#include "lightproof/image/map_levels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "lightproof/core/error.h"
#include "lightproof/core/random.h"
#include "lightproof/image/map_figures.h"
#include "lightproof/warp/cube.h"
#include "lightproof/warp/lat_long.h"
#include "tests/image/picture_files.h"

namespace lightproof {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr Projection kAll[] = {Projection::lat_long, Projection::cube, Projection::mirrored_cube};

/// Some of a projection's sizes, among them those that no power of two divides.
std::vector<Extent> sizes_of(Projection projection) {
  if (is_cube(projection)) return {{1, 1}, {2, 2}, {5, 5}, {16, 16}};
  return {{1, 1}, {2, 1}, {8, 4}, {7, 3}, {3, 5}};
}

template <class Visit>
void for_each_texel(Projection projection, Extent extent, const Visit& visit) {
  for (int face = 0; face < info(projection).faces; ++face) {
    for (int row = 0; row < extent.height; ++row) {
      for (int column = 0; column < extent.width; ++column) visit(LevelTexel{face, column, row});
    }
  }
}

template <class Check>
std::string refusal(const Check& check) {
  try {
    check();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

MapLevels pyramid(Projection projection, Extent base, int levels) {
  MapLevels map = {.projection = projection, .levels = {}};
  for (int i = 0; i < levels; ++i) {
    const auto faces = static_cast<std::size_t>(info(projection).faces);
    map.levels.push_back({static_cast<double>(i) / 8.0,
                          std::vector<Grid<Rgb>>(faces, Grid<Rgb>(level_extent(base, i)))});
  }
  return map;
}

TEST(MapLevels, FindEveryTexelByItsCentre) {
  for (const Projection projection : kAll) {
    for (const Extent extent : sizes_of(projection)) {
      for_each_texel(projection, extent, [&](LevelTexel texel) {
        EXPECT_EQ(texel_at(projection, extent, direction_of(projection, extent, texel)), texel);
      });
    }
  }
}

TEST(MapLevels, HoldThePolesInTheirFirstAndLastRows) {
  for (const Extent extent : sizes_of(Projection::lat_long)) {
    EXPECT_EQ(texel_at(Projection::lat_long, extent, {0, 0, 1}).row, 0);
    EXPECT_EQ(texel_at(Projection::lat_long, extent, {0, 0, -1}).row, extent.height - 1);
  }
}

TEST(MapLevels, FillTheSphere) {
  for (const Projection projection : kAll) {
    for (const Extent extent : sizes_of(projection)) {
      double sum = 0.0;
      for_each_texel(projection, extent,
                     [&](LevelTexel texel) { sum += solid_angle_of(projection, extent, texel); });
      // At most 1536 terms of some roundings each.
      EXPECT_NEAR(sum / kSphere, 1.0, 1e-12) << info(projection).name;
    }
  }
}

TEST(MapLevels, ShowTheTexelsOfAMapFromTheTop) {
  const Grid<Rgb> map = test::numbered_picture({6, 4});
  const MapLevel level = lat_long_level(map, 0.5);
  EXPECT_EQ(level.roughness, 0.5);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 6; ++x) {
      const LevelTexel texel = {0, x, 3 - y};
      EXPECT_EQ(level.faces[0](x, 3 - y), map(x, y));
      EXPECT_EQ(direction_of(Projection::lat_long, {6, 4}, texel),
                direction_of_texel({6, 4}, x, y));
    }
  }
}

/// The face and the texel by table 8.19 of the OpenGL 4.6 specification.
LevelTexel open_gl_texel(double x, double y, double z, int size) {
  const double ax = std::abs(x);
  const double ay = std::abs(y);
  const double az = std::abs(z);
  const auto texel = [&](int face, double sc, double tc, double ma) {
    return LevelTexel{face, static_cast<int>((sc / ma + 1.0) / 2.0 * size),
                      static_cast<int>((tc / ma + 1.0) / 2.0 * size)};
  };
  if (ax > ay && ax > az) return x > 0 ? texel(0, -z, -y, ax) : texel(1, z, -y, ax);
  if (ay > az) return y > 0 ? texel(2, x, z, ay) : texel(3, x, -z, ay);
  return z > 0 ? texel(4, x, -y, az) : texel(5, -x, -y, az);
}

// (X, Y, Z) = (x, z, -y) are the axes of glTF. three.js and a glTF scene in Babylon.js look up
// (-X, Y, Z), Filament looks up (X, Y, Z).
TEST(MapLevels, AreFoundWhereEnginesLookThemUp) {
  const RandomStream stream("cube-engines", 1);
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const Direction d = direction_from_square(stream.point(i));
    const double x = d.x;
    const double y = d.z;
    const double z = -d.y;
    EXPECT_EQ(texel_at(Projection::cube, {64, 64}, d), open_gl_texel(-x, y, z, 64));
    EXPECT_EQ(texel_at(Projection::mirrored_cube, {64, 64}, d), open_gl_texel(x, y, z, 64));
  }
}

TEST(MapLevels, PutTheZenithIntoTheMiddleOfPlusY) {
  for (const Projection projection : {Projection::cube, Projection::mirrored_cube}) {
    EXPECT_EQ(texel_at(projection, {5, 5}, {0, 0, 1}), (LevelTexel{2, 2, 2}));
    EXPECT_EQ(texel_at(projection, {5, 5}, {0, 0, -1}), (LevelTexel{3, 2, 2}));
  }
}

/// A bright spot around a direction: 1 inside of a cone.
struct Spot {
  Direction direction;
  double radius;
  float operator()(Direction d) const {
    return glm::dot(d, direction) > std::cos(radius) ? 1.0F : 0.0F;
  }
};

/// The faces and texels that the spot lights, and how much of its light they hold.
struct Lit {
  std::set<int> faces;
  int texels = 0;
  double light = 0.0;
};

Lit lit_by(const Spot& spot, Projection projection, Extent extent) {
  Lit lit;
  for_each_texel(projection, extent, [&](LevelTexel texel) {
    if (spot(direction_of(projection, extent, texel)) == 0.0F) return;
    lit.faces.insert(texel.face);
    ++lit.texels;
    lit.light += solid_angle_of(projection, extent, texel);
  });
  return lit;
}

/// How far the lit texels may be from the spot's light, relative to it. A lit texel reaches half
/// its diagonal beyond the spot at the most, an unlit one as far into it: what is too much or too
/// little lies in a ring of this width, on one side.
double light_tolerance(double radius, double half_diagonal) {
  return (std::cos(radius) - std::cos(radius + half_diagonal)) / (1.0 - std::cos(radius));
}

constexpr double kSpotRadius = 0.5;
const double kSpotLight = 2.0 * kPi * (1.0 - std::cos(kSpotRadius));

// If a face lacked its part, a half or a third of the light would be missing.
TEST(MapLevels, KeepTheLightOfASpotAcrossEdgesAndCorners) {
  constexpr int kSize = 64;
  const double tolerance = light_tolerance(kSpotRadius, std::sqrt(2.0) / kSize);
  ASSERT_LT(tolerance, 0.1);
  int edges = 0;
  int corners = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const int axes = std::abs(x) + std::abs(y) + std::abs(z);
        if (axes < 2) continue;
        (axes == 2 ? edges : corners) += 1;
        for (const Projection projection : {Projection::cube, Projection::mirrored_cube}) {
          const Spot spot = {glm::normalize(Direction(x, y, z)), kSpotRadius};
          const Lit lit = lit_by(spot, projection, {kSize, kSize});
          EXPECT_EQ(lit.faces.size(), static_cast<std::size_t>(axes));
          EXPECT_NEAR(lit.light / kSpotLight, 1.0, tolerance);
        }
      }
    }
  }
  EXPECT_EQ(edges, 12);
  EXPECT_EQ(corners, 8);
}

TEST(MapLevels, KeepTheLightOfASpotAcrossTheSeamAndThePoles) {
  constexpr Extent kExtent = {128, 64};
  const double tolerance = light_tolerance(kSpotRadius, std::sqrt(0.5) * kPi / 64);
  ASSERT_LT(tolerance, 0.2);
  for (const Direction d : {Direction(-1, 0, 0), {0, 0, 1}, {0, 0, -1}}) {
    const Lit lit = lit_by({d, kSpotRadius}, Projection::lat_long, kExtent);
    EXPECT_NEAR(lit.light / kSpotLight, 1.0, tolerance);
  }
  // The seam is the half-plane of -x: both sides of it are lit.
  EXPECT_EQ(texel_at(Projection::lat_long, kExtent, {-1.0, 1e-3, 0.0}).column, 0);
  EXPECT_EQ(texel_at(Projection::lat_long, kExtent, {-1.0, -1e-3, 0.0}).column, 127);
}

TEST(MapSizes, AreHalvedDownToOneTexel) {
  EXPECT_EQ(level_extent({512, 256}, 0), (Extent{512, 256}));
  EXPECT_EQ(level_extent({512, 256}, 8), (Extent{2, 1}));
  EXPECT_EQ(level_extent({512, 256}, 9), (Extent{1, 1}));
  EXPECT_EQ(level_extent({7, 5}, 1), (Extent{3, 2}));
  for (const auto& [extent, levels] : std::vector<std::pair<Extent, int>>{
           {{1, 1}, 1}, {{2, 1}, 2}, {{3, 3}, 2}, {{4, 1}, 3}, {{512, 256}, 10}, {{7, 100}, 7}}) {
    EXPECT_EQ(most_levels(extent), levels);
    EXPECT_EQ(level_extent(extent, levels - 1), (Extent{1, 1}));
    if (levels > 1) {
      EXPECT_NE(level_extent(extent, levels - 2), (Extent{1, 1}));
    }
  }
}

TEST(MapSizes, AreRefusedWithWhatIsPossible) {
  check_map_size(Projection::lat_long, {1, 1});
  check_map_size(Projection::lat_long, {1000, 999});
  check_map_size(Projection::lat_long, {32768, 16384});
  check_map_size(Projection::cube, {16384, 16384});
  const auto message = [](Projection projection, Extent extent) {
    return refusal([&] { check_map_size(projection, extent); });
  };
  EXPECT_EQ(message(Projection::lat_long, {0, 16}),
            "a map of 0 x 16 texels: 1 x 1 to 32768 x 16384 are possible");
  EXPECT_THAT(message(Projection::lat_long, {20000, 20000}), HasSubstr("20000 x 20000"));
  EXPECT_EQ(message(Projection::cube, {512, 256}),
            "cube faces of 512 x 256 texels: they are square, 1 x 1 to 16384 x 16384");
  EXPECT_THAT(message(Projection::mirrored_cube, {-1, -1}), HasSubstr("-1 x -1"));
}

TEST(LevelCounts, AreRefusedWithWhatIsPossible) {
  check_level_count({512, 256}, 1);
  check_level_count({512, 256}, 10);
  const auto message = [](Extent extent, int levels) {
    return refusal([&] { check_level_count(extent, levels); });
  };
  EXPECT_EQ(message({512, 256}, 11),
            "11 levels of 512 x 256 texels: 1 to 10 are possible, the last of 1 x 1");
  EXPECT_THAT(message({512, 256}, 0), HasSubstr("0 levels"));
  EXPECT_EQ(message({1, 1}, 2), "2 levels of 1 x 1 texels: there is only one");
}

TEST(MapLevels, ArePyramidsOrNot) {
  EXPECT_FALSE(is_pyramid({}));
  EXPECT_TRUE(is_pyramid(pyramid(Projection::lat_long, {7, 5}, 3)));
  EXPECT_TRUE(is_pyramid(pyramid(Projection::cube, {8, 8}, 4)));
  EXPECT_FALSE(is_pyramid(pyramid(Projection::cube, {8, 4}, 1))) << "not square";
  EXPECT_FALSE(is_pyramid(pyramid(Projection::lat_long, {2, 2}, 3))) << "two of 1 x 1";
  MapLevels map = pyramid(Projection::cube, {8, 8}, 2);
  map.levels[1].faces.pop_back();
  EXPECT_FALSE(is_pyramid(map)) << "five faces";
  map = pyramid(Projection::cube, {8, 8}, 1);
  map.levels[0].faces.pop_back();
  EXPECT_FALSE(is_pyramid(map)) << "five faces of level 0";
  map = pyramid(Projection::lat_long, {8, 8}, 2);
  map.levels[1].faces[0] = Grid<Rgb>({8, 8});
  EXPECT_FALSE(is_pyramid(map)) << "not halved";
}

TEST(MapAttributes, SayWhatTheLevelsAre) {
  MapLevels map = pyramid(Projection::cube, {8, 8}, 3);
  map.attributes = {{"method", "quadrature"}, {"software", "another"}};
  const Attributes all = attributes_of(map);
  EXPECT_THAT(all, Contains(Attribute{"levels", "3"}));
  EXPECT_THAT(all, Contains(Attribute{"roughness", "0, 0.125, 0.25"}));
  EXPECT_THAT(all, Contains(Attribute{"method", "quadrature"}));
  EXPECT_THAT(all,
              Contains(Attribute{"projection", std::string(info(Projection::cube).description)}));
  EXPECT_THAT(all, Contains(Attribute{"software", "another"})) << "the map's own value counts";
  EXPECT_EQ(std::ranges::count(all, "software", &Attribute::name), 1);
  const Attributes one = attributes_of(map, 2, 5);
  EXPECT_THAT(one, Contains(Attribute{"level", "2 of 0 to 2"}));
  EXPECT_THAT(one, Contains(Attribute{"face", "-Z"}));
  EXPECT_THAT(one, Contains(Attribute{"roughness", "0.25"}));
  EXPECT_THAT(one, Not(Contains(testing::Field(&Attribute::name, "levels"))));
}

TEST(MapAttributes, NameNoRoughnessOfAnIrradianceMap) {
  MapLevels map = pyramid(Projection::lat_long, {8, 4}, 1);
  map.levels[0].roughness.reset();
  map.chromaticities =
      Chromaticities{{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.329}};
  for (const Attributes& attributes : {attributes_of(map), attributes_of(map, 0, 0)}) {
    EXPECT_THAT(attributes, Not(Contains(testing::Field(&Attribute::name, "roughness"))));
    EXPECT_THAT(attributes, Not(Contains(testing::Field(&Attribute::name, "face"))));
    EXPECT_THAT(attributes, Contains(Attribute{"primaries", "Rec. 2020"}));
    EXPECT_THAT(attributes[0].value, HasSubstr("Lightproof "));
  }
}

TEST(Attributes, AreOneLineOfUtf8) {
  EXPECT_EQ(line_of({"a", "one\ntwo\r\n\tthree"}), "one two   three");
  EXPECT_EQ(line_of({"a", "sky \xc3\xa4"}), "sky \xc3\xa4");
  EXPECT_EQ(line_of({"a", "\xff"}), "\xef\xbf\xbd");
  EXPECT_EQ(file_name_of({"max-error", ""}), "lightproof.max-error");
}

TEST(Projections, AreKnownByTheirNames) {
  for (const ProjectionInfo& row : projections()) {
    EXPECT_EQ(projection_by_name(row.name), row.projection);
    EXPECT_EQ(info(row.projection).name, row.name);
  }
  EXPECT_EQ(projection_by_name("cubemap"), std::nullopt);
}

}  // namespace
}  // namespace lightproof
