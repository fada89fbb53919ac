#include "lightproof/image/level_look_up.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lightproof/core/random.h"
#include "lightproof/image/look_up.h"
#include "lightproof/warp/cube.h"
#include "lightproof/warp/lat_long.h"
#include "tests/image/picture_files.h"

namespace lightproof {
namespace {

constexpr Projection kCubes[] = {Projection::cube, Projection::mirrored_cube};

MapLevels black_cube(Projection projection, int size) {
  return {.projection = projection,
          .levels = {{std::nullopt, std::vector<Grid<Rgb>>(6, Grid<Rgb>({size, size}))}}};
}

double red(Rgb rgb) { return static_cast<double>(rgb.r); }

TEST(LevelLookUp, FindsTexelsAtTheirCentres) {
  for (const Projection projection :
       {Projection::lat_long, Projection::cube, Projection::mirrored_cube}) {
    const Extent extent = is_cube(projection) ? Extent{5, 5} : Extent{6, 3};
    MapLevels map = {.projection = projection, .levels = {{std::nullopt, {}}}};
    for (int face = 0; face < info(projection).faces; ++face) {
      map.levels[0].faces.push_back(test::numbered_picture(extent));
      for (Rgb& rgb : map.levels[0].faces.back().values())
        rgb += Rgb(100.0F * static_cast<float>(face));
    }
    for (int face = 0; face < info(projection).faces; ++face) {
      for (int y = 0; y < extent.height; ++y) {
        for (int x = 0; x < extent.width; ++x) {
          const Rgb found =
              look_up_bilinear(map, 0, direction_of(projection, extent, {face, x, y}));
          // The centre is found to some 2^-52, neighbours differ by less than 600; rounding to
          // float.
          const Rgb expected = map.levels[0].faces[static_cast<std::size_t>(face)](x, y);
          EXPECT_LT(glm::length(found - expected), 1e-4F) << info(projection).name;
        }
      }
    }
  }
}

// By the look-up of luminance in maps, which has its rows from the bottom.
TEST(LevelLookUp, IsThatOfMapsInLatitudeLongitude) {
  for (const Extent extent : {Extent{16, 8}, {7, 3}, {1, 1}}) {
    Grid<double> values(extent);
    Grid<Rgb> map(extent);
    const RandomStream texels("look-up-texels", extent.count());
    for (int y = 0; y < extent.height; ++y) {
      for (int x = 0; x < extent.width; ++x) {
        map(x, y) =
            Rgb(static_cast<float>(texels.point(static_cast<std::uint64_t>(y * 1000 + x)).s));
        values(x, y) = red(map(x, y));
      }
    }
    const MapLevels levels = {.levels = {lat_long_level(map)}};
    const RandomStream stream("look-up", 1);
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const Direction d = direction_from_square(stream.point(i));
      const double expected = look_up_bilinear(values, square_from_direction(d));
      EXPECT_NEAR(red(look_up_bilinear(levels, 0, d)), expected, 1e-7);  // rounding to float
    }
  }
}

/// Directions on either side of the edge between two faces, and on the edge itself.
struct Crossing {
  Direction here;
  Direction there;
};

/// All 12 edges at places along them; `step` apart.
std::vector<Crossing> crossings(double step) {
  std::vector<Crossing> all;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double a : {-1.0, 1.0}) {
      for (const double b : {-1.0, 1.0}) {
        for (int i = 0; i <= 40; ++i) {
          Direction edge;
          edge[axis] = -1.0 + 0.05 * i;
          edge[(axis + 1) % 3] = a;
          edge[(axis + 2) % 3] = b;
          Direction here = edge;
          Direction there = edge;
          here[(axis + 1) % 3] *= 1.0 + step;
          there[(axis + 2) % 3] *= 1.0 + step;
          all.push_back({here, there});
        }
      }
    }
  }
  return all;
}

// One bright texel on one side of an edge: at a distance of 1e-9 from the edge, look-ups on its two
// sides differ by the slope, at most size per unit of u and v each, times the distance: 8e-9 or
// less, beside the rounding to float of values up to 1.
TEST(LevelLookUp, IsContinuousAcrossEveryEdgeAndCornerOfACube) {
  constexpr int kSize = 4;
  for (const Projection projection : kCubes) {
    std::set<int> lit;
    for (int face = 0; face < 6; ++face) {
      for (int i = 0; i < kSize * kSize; ++i) {
        MapLevels map = black_cube(projection, kSize);
        map.levels[0].faces[static_cast<std::size_t>(face)](i % kSize, i / kSize) = Rgb(1.0F);
        for (const auto& [here, there] : crossings(1e-9)) {
          const double value = red(look_up_bilinear(map, 0, here));
          EXPECT_NEAR(value, red(look_up_bilinear(map, 0, there)), 2e-7);
          if (value > 0.0) lit.insert(face * kSize * kSize + i);
        }
      }
    }
    // The twelve texels around each face lie at edges; the inner four do not.
    EXPECT_EQ(lit.size(), 6U * 12U);
  }
}

// On an edge the two texels beside it weigh the same, and in a corner the three around it.
TEST(LevelLookUp, WeighsTheTexelsOfAllFacesAlike) {
  constexpr int kSize = 4;
  for (const Projection projection : kCubes) {
    int edges = 0;
    int corners = 0;
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          const int axes = std::abs(x) + std::abs(y) + std::abs(z);
          if (axes < 2) continue;
          (axes == 2 ? edges : corners) += 1;
          double sum = 0.0;
          for (int face = 0; face < 6; ++face) {
            MapLevels map = black_cube(projection, kSize);
            std::ranges::fill(map.levels[0].faces[static_cast<std::size_t>(face)].values(),
                              Rgb(1.0F));
            const double share = red(look_up_bilinear(map, 0, Direction(x, y, z)));
            EXPECT_TRUE(share == 0.0 || std::abs(share - 1.0 / axes) < 1e-7) << share;
            sum += share;
          }
          EXPECT_NEAR(sum, 1.0, 3e-7);
        }
      }
    }
    EXPECT_EQ(edges, 12);
    EXPECT_EQ(corners, 8);
  }
}

TEST(LevelLookUp, IsContinuousAcrossTheSeamAndAtThePoles) {
  MapLevels map = {.levels = {{std::nullopt, {Grid<Rgb>({8, 4})}}}};
  map.levels[0].faces[0](0, 1) = Rgb(1.0F);
  EXPECT_NEAR(red(look_up_bilinear(map, 0, {-1.0, 1e-9, 0.4})),
              red(look_up_bilinear(map, 0, {-1.0, -1e-9, 0.4})), 1e-7);
  EXPECT_GT(red(look_up_bilinear(map, 0, {-1.0, -1e-9, 0.4})), 0.4) << "half of the bright texel";
  map.levels[0].faces[0] = Grid<Rgb>({8, 4});
  for (Rgb& rgb : map.levels[0].faces[0].row(0)) rgb = Rgb(2.0F);
  for (const Direction d : {Direction(0, 0, 1), {1e-9, 0, 1}, {0, -1e-9, 1}}) {
    EXPECT_EQ(look_up_bilinear(map, 0, d), Rgb(2.0F));
  }
}

TEST(LevelLookUp, InterpolatesBetweenLevelsAndEndsAtTheLast) {
  MapLevels map = {.levels = {}};
  for (const float value : {1.0F, 3.0F, 11.0F}) {
    map.levels.push_back(
        {0.0, {Grid<Rgb>(level_extent({8, 4}, static_cast<int>(map.levels.size())), Rgb(value))}});
  }
  const Direction d = {0.3, 0.2, 0.1};
  for (const auto& [lod, value] : std::vector<std::pair<double, double>>{{-1.0, 1.0},
                                                                         {0.0, 1.0},
                                                                         {0.25, 1.5},
                                                                         {1.0, 3.0},
                                                                         {1.5, 7.0},
                                                                         {2.0, 11.0},
                                                                         {7.0, 11.0}}) {
    EXPECT_EQ(red(look_up_trilinear(map, lod, d)), value) << lod;
  }
}

}  // namespace
}  // namespace lightproof
