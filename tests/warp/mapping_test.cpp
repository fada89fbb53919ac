#include "lightproof/warp/mapping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/warp/lat_long.h"
#include "lightproof/warp/preset.h"

namespace lightproof {
namespace {

struct Case {
  Mapping mapping;
  Extent extent;
};

std::vector<Case> cases() {
  return {{{}, {12, 6}},
          {{.shift = 0.5 / 7}, {7, 4}},
          {node_mapping({8, 5}), {8, 5}},
          {node_mapping({3, 2}), {3, 2}},
          {{MappingKind::octahedral}, {8, 8}},
          {{MappingKind::octahedral}, {5, 5}},
          {{MappingKind::cube_strip}, {24, 4}},
          {{MappingKind::cube_strip}, {18, 3}}};
}

double angle_between(Direction a, Direction b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Each way is a few roundings of numbers below 8, of which a pole or an edge keeps half the digits
// of the square at the worst: angles are held to 1e-14.
TEST(Mapping, LeadsThereAndBack) {
  const RandomStream stream("mapping", 1);
  for (const Case& each : cases()) {
    SCOPED_TRACE(describe(each.mapping));
    for (std::uint64_t i = 0; i < 5000; ++i) {
      const SquarePoint at = stream.point(i);
      const Direction d = direction_at(each.mapping, at);
      ASSERT_NEAR(glm::length(d), 1.0, 1e-15);
      const SquarePoint back = square_point_of(each.mapping, d);
      ASSERT_GE(back.s, 0.0);
      ASSERT_LT(back.s, 1.0);
      ASSERT_GE(back.t, 0.0);
      ASSERT_LE(back.t, 1.0);
      // A cube's points are moved away from the edges between its faces.
      const double moved = each.mapping.kind == MappingKind::cube_strip ? 0x1p-38 : 0.0;
      ASSERT_LE(angle_between(direction_at(each.mapping, back), d), 1e-14 + moved)
          << at.s << ' ' << at.t;
    }
  }
}

// The axes, and what lies in the middle between them: every edge and corner of all mappings.
TEST(Mapping, FindsTheEdgesOfItsOwnSquare) {
  for (const Case& each : cases()) {
    SCOPED_TRACE(describe(each.mapping));
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          if (x == 0 && y == 0 && z == 0) continue;
          const Direction d = glm::normalize(Direction(x, y, z));
          const Direction found = direction_at(each.mapping, square_point_of(each.mapping, d));
          const double moved = each.mapping.kind == MappingKind::cube_strip ? 0x1p-38 : 0.0;
          EXPECT_LE(angle_between(found, d), 1e-14 + moved) << x << ' ' << y << ' ' << z;
        }
      }
    }
  }
}

// Central differences of step h err by h^2/6 of the third derivative and by 1e-16/h: of unit
// vectors that change as fast as here, below 1e-7 in all.
TEST(Mapping, KnowsItsJacobian) {
  const RandomStream stream("mapping-jacobian", 1);
  constexpr double kStep = 1e-6;
  for (const Case& each : cases()) {
    SCOPED_TRACE(describe(each.mapping));
    for (std::uint64_t i = 0; i < 500; ++i) {
      SquarePoint at = stream.point(i);
      // Away from folds, which lie at multiples of 1/60 of either, and of their sum.
      const auto is_near = [](double value) {
        return std::abs(value * 60.0 - std::round(value * 60.0)) < 1e-3;
      };
      if (is_near(at.s) || is_near(at.t) || is_near(at.s + at.t) || is_near(at.s - at.t)) continue;
      const auto slope = [&](double s, double t) {
        return (direction_at(each.mapping, {at.s + s, at.t + t}) -
                direction_at(each.mapping, {at.s - s, at.t - t})) /
               (2.0 * kStep);
      };
      const double found = glm::length(glm::cross(slope(kStep, 0.0), slope(0.0, kStep)));
      EXPECT_NEAR(found, solid_angle_per_square(each.mapping, at), 1e-6) << at.s << ' ' << at.t;
    }
  }
}

// Turns of 1e-5: second derivatives add up to 1e-5 of 1/sin^2 < 2e3 where |z| < 0.999, which is why
// nearer to a pole nothing is asked; a turn over an edge of a face, a fold or the square is not one
// of a smooth map. That bounds are met, to a tenth, by some turn says that they are no larger.
TEST(Mapping, BoundsWhatASmallTurnDoes) {
  constexpr double kTurn = 1e-5;
  const RandomStream stream("turns", 1);
  for (const Case& each : cases()) {
    SCOPED_TRACE(describe(each.mapping));
    TurnEffect most = {0.0, 0.0, 0.0};
    for (std::uint64_t i = 0; i < 20000; ++i) {
      const SquarePoint at = stream.point(2 * i);
      const Direction d = direction_at(each.mapping, at);
      if (std::abs(d.z) > 0.999) continue;
      const double turn = 2.0 * kPi * stream.point(2 * i + 1).s;
      const Direction across = glm::normalize(glm::cross(d, Direction(0.0, 0.0, 1.0)));
      const Direction tangent = std::cos(turn) * across + std::sin(turn) * glm::cross(across, d);
      const SquarePoint to = square_point_of(each.mapping, glm::normalize(d + kTurn * tangent));
      const double s = std::abs(to.s - at.s) / kTurn;
      const double t = std::abs(to.t - at.t) / kTurn;
      const double before = solid_angle_per_square(each.mapping, at);
      const double jacobian =
          std::abs(solid_angle_per_square(each.mapping, to) / before - 1.0) / kTurn;
      const TurnEffect bound = effect_of_turn(each.mapping, at);
      // To the other side of an edge a point jumps by far more than these.
      if (s > 100.0 || t > 100.0 || jacobian > 1000.0) continue;
      ASSERT_LE(s, bound.s * 1.03) << i;
      ASSERT_LE(t, bound.t * 1.03) << i;
      ASSERT_LE(jacobian, bound.jacobian * 1.03 + 1e-9) << i;
      most.s = std::max(most.s, s / bound.s);
      most.t = std::max(most.t, t / bound.t);
      if (bound.jacobian > 0.0) most.jacobian = std::max(most.jacobian, jacobian / bound.jacobian);
    }
    EXPECT_GT(most.s, 0.9);
    EXPECT_GT(most.t, 0.9);
    EXPECT_TRUE(most.jacobian > 0.9 || is_equal_area(each.mapping));
  }
}

TEST(Mapping, DividesTheSphereAmongItsTexels) {
  for (const Case& each : cases()) {
    SCOPED_TRACE(describe(each.mapping));
    EXPECT_EQ(size_fault(each.mapping, each.extent), "");
    double sum = 0.0;
    for (int y = 0; y < each.extent.height; ++y) {
      for (int x = 0; x < each.extent.width; ++x) {
        sum += texel_solid_angle(each.mapping, each.extent, x, y);
      }
    }
    EXPECT_NEAR(sum, kSphere, 1e-13);
  }
}

// The midpoint rule in 64 x 64 cells of a texel errs by h^2/24 of the second derivative of the
// Jacobian: below (1/64)^2/24 pi^2 of it in the widest texels, and where it has a kink, at a fold
// between rows, nothing more, since folds lie between texels.
TEST(Mapping, TexelsHaveTheSolidAngleOfTheirJacobian) {
  constexpr int kCells = 64;
  for (const Case& each : cases()) {
    SCOPED_TRACE(describe(each.mapping));
    for (int y = 0; y < each.extent.height; ++y) {
      for (int x = 0; x < each.extent.width; ++x) {
        const SquareCell cell = texel_cell(each.extent, x, y);
        double sum = 0.0;
        for (int j = 0; j < kCells; ++j) {
          for (int i = 0; i < kCells; ++i) {
            const SquarePoint at = {cell.left + (i + 0.5) / kCells * (cell.right - cell.left),
                                    cell.bottom + (j + 0.5) / kCells * (cell.top - cell.bottom)};
            sum += solid_angle_per_square(each.mapping, at);
          }
        }
        const double exact = texel_solid_angle(each.mapping, each.extent, x, y);
        EXPECT_NEAR(sum * cell.area() / (kCells * kCells), exact, 1.1e-3 * exact) << x << ' ' << y;
      }
    }
  }
}

TEST(Mapping, OfAnOctahedralPictureIsThatOfPbrt) {
  const RandomStream stream("mapping-pbrt", 1);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const SquarePoint at = stream.point(i);
    EXPECT_EQ(direction_at({MappingKind::octahedral}, at),
              direction_from_image(Preset::pbrt_v4, at));
  }
}

TEST(Mapping, PutsNodesIntoTheMiddlesOfTheirTexels) {
  const Extent texels = {8, 5};
  const Mapping mapping = node_mapping(texels);
  for (int y = 1; y + 1 < texels.height; ++y) {
    for (int x = 0; x < texels.width; ++x) {
      const Direction node = direction_from_image(
          Preset::openexr, {static_cast<double>(x) / texels.width, y / (texels.height - 1.0)});
      EXPECT_LE(angle_between(direction_at(mapping, texel_cell(texels, x, y).centre()), node),
                1e-15);
    }
  }
  // The rows of the poles reach from the node half the way to the next one.
  EXPECT_NEAR(direction_at(mapping, {0.5, 0.2}).z, -std::cos(kPi / 8.0), 1e-15);
  EXPECT_NEAR(direction_at(mapping, {0.5, 0.8}).z, std::cos(kPi / 8.0), 1e-15);
}

TEST(Mapping, NamesWhatASizeLacks) {
  EXPECT_NE(size_fault({MappingKind::octahedral}, {8, 4}), "");
  EXPECT_NE(size_fault({MappingKind::cube_strip}, {25, 4}), "");
  EXPECT_NE(size_fault({MappingKind::node_rows, 0.0, 1}, {4, 1}), "");
  for (const MappingInfo& each : mappings()) EXPECT_EQ(info(each.kind).name, each.name);
}

// What a dump of another program may name. Under the undefined-behaviour sanitizer.
TEST(CubeMapping, TakesPointsThatAreNone) {
  const Mapping faces = {MappingKind::cube_strip};
  const double nan = std::nan("");
  EXPECT_TRUE(std::isnan(solid_angle_per_square(faces, {nan, nan})));
  EXPECT_TRUE(std::isfinite(solid_angle_per_square(faces, {1e300, 0.5})));
  EXPECT_FALSE(solid_angle_per_square(faces, square_point_of(faces, {nan, nan, nan})) > 0.0);
}

}  // namespace
}  // namespace lightproof
