#include "lightproof/warp/octahedral.h"

#include <gtest/gtest.h>

#include "lightproof/core/random.h"

namespace lightproof {
namespace {

// u and v carry at most 6 roundings of 2^-53; the map stretches by less than 8 per unit of the
// square, and the trigonometry adds 4 roundings: 52 * 2^-53 = 5.8e-15.
constexpr double kTolerance = 6e-15;

Direction random_direction(SquarePoint u) {
  const double z = 1.0 - 2.0 * u.s;
  const double sine = std::sqrt(1.0 - z * z);
  return {sine * std::cos(2.0 * kPi * u.t), sine * std::sin(2.0 * kPi * u.t), z};
}

void expect_near(Direction a, Direction b) {
  EXPECT_LT(glm::length(a - b), kTolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(Octahedral, ReturnsEveryDirection) {
  const RandomStream stream("octahedral", 1);
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Direction d = glm::normalize(random_direction(stream.point(i)));
    expect_near(octahedral_from_square(square_from_octahedral(d)), d);
  }
}

TEST(Octahedral, KeepsDirectionsCloseToThePoles) {
  for (const double tiny : {1e-300, 1e-20, 1e-10, 1e-8}) {
    for (const double z : {1.0, -1.0}) {
      const Direction d = glm::normalize(Direction(tiny, -tiny, z));
      expect_near(octahedral_from_square(square_from_octahedral(d)), d);
    }
  }
}

TEST(Octahedral, GivesUnitVectors) {
  const RandomStream stream("octahedral-square", 1);
  for (std::uint64_t i = 0; i < 20000; ++i) {
    EXPECT_NEAR(glm::length(octahedral_from_square(stream.point(i))), 1.0, kTolerance);
  }
}

// Clarberg 2008: the inner diamond is the upper hemisphere, r = sqrt(1 - |z|) its radius.
TEST(Octahedral, PlacesTheKnownDirections) {
  const auto expect_at = [](Direction d, double s, double t) {
    EXPECT_NEAR(square_from_octahedral(d).s, s, 1e-15);
    EXPECT_NEAR(square_from_octahedral(d).t, t, 1e-15);
  };
  expect_at({0, 0, 1}, 0.5, 0.5);
  expect_at({1, 0, 0}, 1.0, 0.5);
  expect_at({0, 1, 0}, 0.5, 1.0);
  expect_at({-1, 0, 0}, 0.0, 0.5);
  expect_at({0, -1, 0}, 0.5, 0.0);
  expect_at({std::sqrt(0.75), 0, 0.5}, 0.5 + 0.5 * std::sqrt(0.5), 0.5);
  expect_at({std::sqrt(0.5), -std::sqrt(0.5), 0}, 0.75, 0.25);
  for (const SquarePoint corner : {SquarePoint{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
    expect_near(octahedral_from_square(corner), {0, 0, -1});
  }
}

// The sphere's rows of equal height in z hold equal shares; 4 sigma of a binomial share 1/8 of
// N = 80000 points is 4 sqrt(7/64 / 80000) = 0.0047.
TEST(Octahedral, SpreadsUniformPointsEvenly) {
  const RandomStream stream("octahedral-area", 1);
  std::array<int, 8> rows = {};
  std::array<int, 8> octants = {};
  constexpr int kPoints = 80000;
  for (int i = 0; i < kPoints; ++i) {
    const Direction d = octahedral_from_square(stream.point(static_cast<std::uint64_t>(i)));
    ++rows[static_cast<std::size_t>(std::min(7.0, 4.0 * (d.z + 1.0)))];
    ++octants[static_cast<std::size_t>((d.x > 0) + 2 * (d.y > 0) + 4 * (d.z > 0))];
  }
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(rows[i] / double{kPoints}, 0.125, 0.0047);
    EXPECT_NEAR(octants[i] / double{kPoints}, 0.125, 0.0047);
  }
  EXPECT_DOUBLE_EQ(octahedral_pdf({0, 0, 1}).value * kSphere, 1.0);
}

}  // namespace
}  // namespace lightproof
