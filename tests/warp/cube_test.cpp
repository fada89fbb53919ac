#include "lightproof/warp/cube.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <vector>

#include "lightproof/core/random.h"

namespace lightproof {
namespace {

Direction random_direction(const RandomStream& stream, std::uint64_t i) {
  const SquarePoint u = stream.point(i);
  const double z = 1.0 - 2.0 * u.s;
  const double sine = std::sqrt(1.0 - z * z);
  return {sine * std::cos(2.0 * kPi * u.t), sine * std::sin(2.0 * kPi * u.t), z};
}

/// The face's number and (s, t) by table 8.19 of the OpenGL 4.6 specification, of r = (x, y, z).
struct OpenGlPoint {
  int face;
  double s;
  double t;
};

OpenGlPoint open_gl_point(double x, double y, double z) {
  const double ax = std::abs(x);
  const double ay = std::abs(y);
  const double az = std::abs(z);
  const auto point = [](int face, double sc, double tc, double ma) {
    return OpenGlPoint{face, 0.5 * (sc / ma + 1.0), 0.5 * (tc / ma + 1.0)};
  };
  if (ax > ay && ax > az) return x > 0 ? point(0, -z, -y, ax) : point(1, z, -y, ax);
  if (ay > az) return y > 0 ? point(2, x, z, ay) : point(3, x, -z, ay);
  return z > 0 ? point(4, x, -y, az) : point(5, -x, -y, az);
}

TEST(Cube, FollowsTheTableOfOpenGl) {
  const RandomStream stream("cube-table", 1);
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Direction d = random_direction(stream, i);
    const OpenGlPoint expected = open_gl_point(-d.x, d.z, -d.y);
    const CubePoint found = cube_from_direction(d);
    ASSERT_EQ(static_cast<int>(found.face), expected.face);
    // Both are a quotient, a sum and a product: four roundings of numbers up to 1.
    EXPECT_NEAR(found.u, expected.s, 5e-16);
    EXPECT_NEAR(found.v, expected.t, 5e-16);
  }
}

TEST(Cube, PutsTheAxesOfTheWorldIntoTheMiddlesOfFaces) {
  const auto expect_middle = [](Direction d, CubeFace face) {
    const CubePoint at = cube_from_direction(d);
    EXPECT_EQ(at.face, face) << name_of(face);
    EXPECT_EQ(at.u, 0.5);
    EXPECT_EQ(at.v, 0.5);
    EXPECT_EQ(direction_from_cube({face, 0.5, 0.5}), d) << name_of(face);
  };
  expect_middle({0, 0, 1}, CubeFace::positive_y);
  expect_middle({0, 0, -1}, CubeFace::negative_y);
  expect_middle({1, 0, 0}, CubeFace::negative_x);
  expect_middle({-1, 0, 0}, CubeFace::positive_x);
  expect_middle({0, 1, 0}, CubeFace::negative_z);
  expect_middle({0, -1, 0}, CubeFace::positive_z);
}

// An eye that looks along f with its head towards h has f x h at its right hand, in right-handed
// axes such as the world's. Up is against `down`.
TEST(Cube, ShowsEveryFaceAsAnEyeInTheCentreSeesIt) {
  for (const CubeFace face : kCubeFaces) {
    const Direction forward = direction_from_cube({face, 0.5, 0.5});
    const Direction right = direction_from_cube({face, 0.75, 0.5}) - forward;
    const Direction up = direction_from_cube({face, 0.5, 0.25}) - forward;
    EXPECT_GT(glm::dot(glm::cross(forward, up), right), 0.0) << name_of(face) << " is mirrored";
  }
}

TEST(Cube, KeepsTheHorizonLevel) {
  for (const CubeFace face :
       {CubeFace::positive_x, CubeFace::negative_x, CubeFace::positive_z, CubeFace::negative_z}) {
    EXPECT_EQ(direction_from_cube({face, 0.3, 0.5}).z, 0.0) << name_of(face);
    EXPECT_GT(direction_from_cube({face, 0.3, 0.4}).z, 0.0) << name_of(face) << " is upside down";
  }
}

TEST(Cube, ReturnsEveryDirection) {
  const RandomStream stream("cube", 1);
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Direction d = random_direction(stream, i);
    const CubePoint at = cube_from_direction(d);
    // u and v carry three roundings of 2^-53 each and are doubled; normalising adds two.
    EXPECT_LT(glm::length(direction_from_cube(at) - d), 1.5e-15);
  }
}

TEST(Cube, StaysInsideTheFacesAtEdgesAndCorners) {
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      for (const double z : {-1.0, 0.0, 1.0}) {
        if (x == 0.0 && y == 0.0 && z == 0.0) continue;
        const CubePoint at = cube_from_direction({x, y, z});
        EXPECT_TRUE(at.u >= 0.0 && at.u <= 1.0 && at.v >= 0.0 && at.v <= 1.0);
        const Direction back = direction_from_cube(at);
        EXPECT_LT(glm::length(back - glm::normalize(Direction(x, y, z))), 1e-15);
        const CubeTexel texel = texel_at({x, y, z}, 5);
        EXPECT_TRUE(texel.column >= 0 && texel.column < 5 && texel.row >= 0 && texel.row < 5);
      }
    }
  }
}

// The midpoint rule errs by |f''| / 24 n^2 in each of u and v; the second derivatives of the
// integrand stay below 48 (in the middle: 3 * 4 * 2^2). So 6 * 2 * 48 / (24 * 10^6) = 2.4e-5.
TEST(Cube, JacobianIntegratesToTheSphere) {
  constexpr int kSteps = 1000;
  double sum = 0.0;
  for (int y = 0; y < kSteps; ++y) {
    for (int x = 0; x < kSteps; ++x) {
      sum += solid_angle_per_face((x + 0.5) / kSteps, (y + 0.5) / kSteps);
    }
  }
  EXPECT_NEAR(6.0 * sum / (kSteps * kSteps), kSphere, 2.4e-5);
}

// The density of directions is the area that small steps of u and v span on the sphere.
TEST(Cube, JacobianIsTheAreaThatStepsSpan) {
  const RandomStream stream("cube-jacobian", 1);
  constexpr double kStep = 1e-4;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const SquarePoint at = stream.point(i);
    const CubeFace face = kCubeFaces[i % 6];
    const auto along = [&](double du, double dv) {
      return (direction_from_cube({face, at.s + du, at.t + dv}) -
              direction_from_cube({face, at.s - du, at.t - dv})) /
             (2.0 * kStep);
    };
    const double area = glm::length(glm::cross(along(kStep, 0.0), along(0.0, kStep)));
    // Central differences err by a sixth of the third derivative, at most 8 * 3 here, times step^2,
    // and by rounding, 2^-53 / step.
    EXPECT_NEAR(area, solid_angle_per_face(at.s, at.t), 1e-6);
  }
}

/// Of the rectangle from the face's middle to (a, b), in offsets from it: the closed form with arc
/// tangents that is usually printed. It cancels for small texels.
double solid_angle_to(double a, double b) {
  return std::atan2(a * b, std::sqrt(a * a + b * b + 1.0));
}

TEST(CubeTexels, HaveTheSolidAngleOfTheClosedForm) {
  for (const int size : {1, 2, 3, 5, 16, 33}) {
    for (int row = 0; row < size; ++row) {
      for (int column = 0; column < size; ++column) {
        const double left = 2.0 * column / size - 1.0;
        const double right = 2.0 * (column + 1) / size - 1.0;
        const double top = 2.0 * row / size - 1.0;
        const double bottom = 2.0 * (row + 1) / size - 1.0;
        const double expected = solid_angle_to(right, bottom) - solid_angle_to(left, bottom) -
                                solid_angle_to(right, top) + solid_angle_to(left, top);
        // Four numbers up to 0.53, of three roundings each, are added.
        EXPECT_NEAR(cube_texel_solid_angle(size, column, row), expected, 2e-15);
      }
    }
  }
}

TEST(CubeTexels, FillTheSphere) {
  for (const int size : {1, 2, 3, 7, 64, 500}) {
    double sum = 0.0;
    for (int row = 0; row < size; ++row) {
      for (int column = 0; column < size; ++column) {
        sum += cube_texel_solid_angle(size, column, row);
      }
    }
    // Each of the size^2 additions errs by 2^-53 of the sum at most, each term by a few 2^-53 of
    // itself.
    EXPECT_NEAR(6.0 * sum / kSphere, 1.0, 0x1p-53 * (1.0 * size * size + 16.0)) << size;
  }
}

// At 16384 the closed form would have seven digits left. The Jacobian at the centre is off by
// h^2 / 24 times its second derivatives over itself, at most 2 * 12 / 24 h^2 = 4e-9.
TEST(CubeTexels, LoseNoDigitsWhereTheyAreSmall) {
  constexpr int kSize = 16384;
  for (const int column : {0, 1, 5000, 8191, 8192, 16383}) {
    for (const int row : {0, 777, 8192, 16383}) {
      const double centre =
          solid_angle_per_face((column + 0.5) / kSize, (row + 0.5) / kSize) / (1.0 * kSize * kSize);
      EXPECT_NEAR(cube_texel_solid_angle(kSize, column, row) / centre, 1.0, 4e-9);
    }
  }
}

TEST(CubeTexels, AreFoundByTheirCentres) {
  for (const int size : {1, 2, 3, 17, 256}) {
    for (const CubeFace face : kCubeFaces) {
      for (const int column : {0, size / 3, size - 1}) {
        for (const int row : {0, size / 2, size - 1}) {
          const CubeTexel texel = {face, column, row};
          EXPECT_EQ(texel_at(direction_of(texel, size), size), texel);
        }
      }
    }
  }
}

/// The steps over the four edges of a face from its texel at place i along the edge: inside,
/// outside.
std::vector<std::pair<CubeTexel, CubeTexel>> steps_out(CubeFace face, int i, int size) {
  return {{{face, 0, i}, {face, -1, i}},
          {{face, size - 1, i}, {face, size, i}},
          {{face, i, 0}, {face, i, -1}},
          {{face, i, size - 1}, {face, i, size}}};
}

/// Of all texels of other faces the one whose centre is nearest.
CubeTexel nearest_on_other_faces(CubeTexel texel, int size) {
  const Direction from = direction_of(texel, size);
  CubeTexel nearest = {};
  double largest = -2.0;
  for (const CubeFace face : kCubeFaces) {
    if (face == texel.face) continue;
    for (int row = 0; row < size; ++row) {
      for (int column = 0; column < size; ++column) {
        const double cosine = glm::dot(from, direction_of({face, column, row}, size));
        if (cosine <= largest) continue;
        largest = cosine;
        nearest = {face, column, row};
      }
    }
  }
  return nearest;
}

// Corner texels have two neighbours on other faces, which are equally near: there only symmetry is
// asked.
TEST(CubeEdges, JoinTheNearestTexelsAndJoinThemBothWays) {
  for (const int size : {1, 2, 5, 8}) {
    std::set<std::set<CubeFace>> edges;
    for (const CubeFace face : kCubeFaces) {
      for (int i = 0; i < size; ++i) {
        for (const auto& [inside, outside] : steps_out(face, i, size)) {
          const CubeTexel neighbour = across_edge(outside, size);
          edges.insert({face, neighbour.face});
          if (i > 0 && i < size - 1) {
            EXPECT_EQ(neighbour, nearest_on_other_faces(inside, size));
          }
          int returns = 0;
          for (int k = 0; k < size; ++k) {
            for (const auto& [from, to] : steps_out(neighbour.face, k, size)) {
              returns += from == neighbour && across_edge(to, size) == inside ? 1 : 0;
            }
          }
          EXPECT_EQ(returns, 1) << name_of(face) << " and " << name_of(neighbour.face);
        }
      }
    }
    EXPECT_EQ(edges.size(), 12U);
  }
}

TEST(CubeEdges, AreTheSameDirectionsSeenFromBothFaces) {
  constexpr int kSize = 6;
  for (const CubeFace face : kCubeFaces) {
    for (int i = 0; i < kSize; ++i) {
      for (const auto& [inside, outside] : steps_out(face, i, kSize)) {
        // Half way over the edge from the texel's centre lies the edge itself.
        const auto between = [](int a, int b) { return 0.5 * (a + b + 1.0) / kSize; };
        const Direction edge = direction_from_cube(
            {face, between(inside.column, outside.column), between(inside.row, outside.row)});
        const CubeTexel neighbour = across_edge(outside, kSize);
        const double here = glm::dot(edge, direction_of(inside, kSize));
        const double there = glm::dot(edge, direction_of(neighbour, kSize));
        EXPECT_NEAR(here, there, 1e-15);
      }
    }
  }
}

TEST(CubeCorners, AreWhereThreeTexelsMeet) {
  constexpr int kSize = 4;
  std::set<std::set<CubeFace>> corners;
  for (const CubeFace face : kCubeFaces) {
    for (const int column : {0, kSize - 1}) {
      for (const int row : {0, kSize - 1}) {
        const CubeTexel beside = across_edge({face, column == 0 ? -1 : kSize, row}, kSize);
        const CubeTexel below = across_edge({face, column, row == 0 ? -1 : kSize}, kSize);
        corners.insert({face, beside.face, below.face});
        const Direction corner =
            direction_from_cube({face, column == 0 ? 0.0 : 1.0, row == 0 ? 0.0 : 1.0});
        for (const CubeTexel texel : {CubeTexel{face, column, row}, beside, below}) {
          // The centre nearest to a corner is the corner texel's: 3/4 of the way along both sides.
          const double cosine =
              (1.0 + 2.0 * 0.75) / (std::sqrt(3.0) * std::sqrt(1.0 + 2.0 * 0.75 * 0.75));
          EXPECT_NEAR(glm::dot(corner, direction_of(texel, kSize)), cosine, 1e-15);
        }
      }
    }
  }
  EXPECT_EQ(corners.size(), 8U);
  for (const std::set<CubeFace>& faces : corners) EXPECT_EQ(faces.size(), 3U);
}

}  // namespace
}  // namespace lightproof
