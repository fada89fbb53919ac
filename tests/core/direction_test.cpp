#include "lightproof/core/direction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lightproof/core/random.h"

namespace lightproof {
namespace {

// Every component is a few products and sums of numbers up to 2, and 1/(1 + |n.z|) loses nothing;
// the normal's own length is off by an ulp or two.
constexpr double kRoundings = 1e-15;

constexpr Direction kAxes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

void expect_right_handed_frame(Direction normal) {
  const Frame frame = frame_around(normal);
  SCOPED_TRACE(testing::Message() << normal.x << ", " << normal.y << ", " << normal.z);
  EXPECT_EQ(frame.normal, normal);
  EXPECT_NEAR(glm::length(frame.tangent), 1.0, kRoundings);
  EXPECT_NEAR(glm::length(frame.bitangent), 1.0, kRoundings);
  EXPECT_NEAR(glm::dot(frame.tangent, frame.bitangent), 0.0, kRoundings);
  EXPECT_NEAR(glm::dot(frame.tangent, normal), 0.0, kRoundings);
  EXPECT_NEAR(glm::dot(frame.bitangent, normal), 0.0, kRoundings);
  EXPECT_NEAR(glm::length(glm::cross(frame.tangent, frame.bitangent) - normal), 0.0, kRoundings);
}

TEST(Frame, IsRightHandedAtTheAxes) {
  for (const Direction axis : kAxes) expect_right_handed_frame(axis);
}

TEST(Frame, IsRightHandedCloseToTheAxes) {
  for (const Direction axis : kAxes) {
    for (const Direction aside : kAxes) {
      for (const double distance : {1e-3, 1e-8, 1e-12, 1e-16, 1e-300}) {
        expect_right_handed_frame(glm::normalize(axis + distance * aside));
      }
    }
  }
}

TEST(Frame, IsRightHandedOnTheHorizonWithEitherZero) {
  for (int i = 0; i < 360; ++i) {
    const double phi = i * std::acos(-1.0) / 180.0;
    expect_right_handed_frame({std::cos(phi), std::sin(phi), 0.0});
    expect_right_handed_frame({std::cos(phi), std::sin(phi), -0.0});
  }
}

TEST(Frame, TakesDirectionsToTheWorldAndBack) {
  const Frame frame = frame_around(glm::normalize(Direction(0.3, -0.5, -0.4)));
  const Direction local = glm::normalize(Direction(0.2, 0.9, -0.1));
  EXPECT_NEAR(glm::distance(frame.to_local(frame.to_world(local)), local), 0.0, kRoundings);
  EXPECT_NEAR(glm::distance(frame.to_local(frame.bitangent), {0, 1, 0}), 0.0, kRoundings);
}

TEST(Frame, IsRightHandedAtRandomNormals) {
  const RandomStream stream("Frame.IsRightHandedAtRandomNormals", 1);
  for (std::uint64_t i = 0; i < 10000; ++i) {
    const SquarePoint u = stream.point(i);
    const double z = 2.0 * u.t - 1.0;
    const double sine = std::sqrt((1.0 - z) * (1.0 + z));
    const double phi = 2.0 * kPi * u.s;
    expect_right_handed_frame(
        glm::normalize(Direction{sine * std::cos(phi), sine * std::sin(phi), z}));
  }
}

TEST(Frame, ToWorldTakesTheAxesToTheFrame) {
  const Frame frame = frame_around(glm::normalize(Direction{0.3, -0.5, 0.7}));
  EXPECT_EQ(frame.to_world({1, 0, 0}), frame.tangent);
  EXPECT_EQ(frame.to_world({0, 1, 0}), frame.bitangent);
  EXPECT_EQ(frame.to_world({0, 0, 1}), frame.normal);
  const Direction mixed = frame.to_world({0.6, 0.0, 0.8});
  EXPECT_NEAR(glm::dot(mixed, frame.tangent), 0.6, kRoundings);
  EXPECT_NEAR(glm::dot(mixed, frame.normal), 0.8, kRoundings);
}

TEST(Reflection, KeepsTheNormalAndTurnsTheTangent) {
  for (const Direction axis : kAxes) EXPECT_EQ(reflect_about(axis, axis), axis);
  EXPECT_EQ(reflect_about({0.6, 0.0, 0.8}, {0, 0, 1}), Direction(-0.6, 0.0, 0.8));
  EXPECT_EQ(reflect_about({1, 0, 0}, {0, 1, 0}), Direction(-1, 0, 0));
}

TEST(Reflection, IsItsOwnInverseAndKeepsTheAngle) {
  const RandomStream stream("Reflection.IsItsOwnInverseAndKeepsTheAngle", 1);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const SquarePoint u = stream.point(2 * i);
    const SquarePoint w = stream.point(2 * i + 1);
    const Direction v = glm::normalize(Direction{u.s - 0.5, u.t - 0.5, w.s - 0.5});
    const Direction n = glm::normalize(Direction{w.t - 0.5, u.s - 0.3, u.t - 0.7});
    const Direction mirrored = reflect_about(v, n);
    EXPECT_NEAR(glm::length(mirrored), 1.0, 2.0 * kRoundings);
    EXPECT_NEAR(glm::dot(mirrored, n), glm::dot(v, n), 2.0 * kRoundings);
    EXPECT_NEAR(glm::length(glm::cross(mirrored + v, n)), 0.0, 4.0 * kRoundings);
    EXPECT_NEAR(glm::length(reflect_about(mirrored, n) - v), 0.0, 4.0 * kRoundings);
  }
}

}  // namespace
}  // namespace lightproof
