#include "lightproof/warp/frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "lightproof/core/random.h"
#include "lightproof/warp/frame_errors.h"

namespace lightproof {
namespace {

// Every entry is a few products and sums of numbers up to 2, none of which cancel; an entry of
// M^T M adds three products of two entries, and the normal was rounded. A dozen roundings, the
// unit being half the epsilon.
template <class T>
constexpr double kRoundings = 6.0 * std::numeric_limits<T>::epsilon();

constexpr double kDistances[] = {0.0,  1e-300, 1e-9, 1e-8, 1e-6, 1e-5, 1e-4, 4e-4, 5e-4,
                                 1e-3, 1e-2,   0.1,  0.5,  1.0,  1.57, 1.58, 2.0,  3.0};

template <class T>
UnitVector<T> near_pole(double pole, double distance, double phi) {
  return {static_cast<T>(std::sin(distance) * std::cos(phi)),
          static_cast<T>(std::sin(distance) * std::sin(phi)),
          static_cast<T>(pole * std::cos(distance))};
}

template <class T, class Visit>
void for_each_normal(const Visit& visit) {
  for (const double pole : {-1.0, 1.0}) {
    for (const double distance : kDistances) {
      for (int i = 0; i < 24; ++i) visit(near_pole<T>(pole, distance, i * kPi / 12.0));
    }
  }
  const RandomStream stream("Frames", 1);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const SquarePoint u = stream.point(i);
    visit(near_pole<T>(1.0, std::acos(1.0 - 2.0 * u.t), 2.0 * kPi * u.s));
  }
}

template <class T>
void expect_right_handed(const FrameOf<T>& frame, UnitVector<T> normal) {
  EXPECT_EQ(frame.normal, normal);
  EXPECT_LE(orthonormality_error(frame), kRoundings<T>);
  const double determinant = glm::dot(glm::cross(frame.tangent, frame.bitangent), normal);
  EXPECT_NEAR(determinant, 1.0, 3.0 * kRoundings<T>);
}

template <class T>
void expect_sound_frames() {
  for_each_normal<T>([](UnitVector<T> n) {
    SCOPED_TRACE(testing::Message() << n.x << ", " << n.y << ", " << n.z);
    expect_right_handed(duff_frame(n), n);
    expect_right_handed(householder_frame(n), n);
    expect_right_handed(tangent_frame(n), n);
    expect_right_handed(quaternion_frame(n), n);
  });
}

TEST(Frames, OfDuffHouseholderTangentAndFlippedQuaternionAreSoundInFloatEverywhere) {
  expect_sound_frames<float>();
}
TEST(Frames, OfDuffHouseholderTangentAndFlippedQuaternionAreSoundInDoubleEverywhere) {
  expect_sound_frames<double>();
}

TEST(Frames, OfDuffAreTheOnesInUse) {
  for_each_normal<double>([](Direction n) {
    const Frame used = frame_around(n);
    const Frame here = to_frame(duff_frame(n));
    EXPECT_EQ(here.tangent, used.tangent);
    EXPECT_EQ(here.bitangent, used.bitangent);
  });
}

// Both are the columns of one reflection.
TEST(Frames, OfHouseholderAreThoseOfDuffToRounding) {
  for_each_normal<double>([](Direction n) {
    const auto duff = duff_frame(n);
    const auto householder = householder_frame(n);
    EXPECT_NEAR(glm::distance(duff.tangent, householder.tangent), 0.0, kRoundings<double>);
    EXPECT_NEAR(glm::distance(duff.bitangent, householder.bitangent), 0.0, kRoundings<double>);
  });
}

/// q (0, v) q^-1 by Hamilton's product.
Direction rotated(const HorizontalQuaternion<double>& q, Direction v) {
  const Direction axis = {q.x, q.y, 0.0};
  const Direction twice = 2.0 * glm::cross(axis, v);
  return v + q.w * twice + glm::cross(axis, twice);
}

TEST(Frames, OfTheQuaternionAreTheImagesOfItsRotation) {
  const RandomStream stream("FramesOfTheQuaternion", 1);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const SquarePoint u = stream.point(i);
    // Half a radian and more from both poles, next to which half the angle loses digits.
    const Direction n = near_pole<double>(1.0, 0.5 + u.t * (kPi - 1.0), 2.0 * kPi * u.s);
    const auto q = quaternion_from_z(n);
    constexpr double kError = 20.0 * kRoundings<double>;
    EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y, 1.0, kError);
    EXPECT_NEAR(glm::distance(rotated(q, {0, 0, 1}), n), 0.0, kError);
    for (const auto& frame : {bare_quaternion_frame(n), published_quaternion_frame(n)}) {
      EXPECT_NEAR(glm::distance(rotated(q, {1, 0, 0}), frame.tangent), 0.0, kError);
      EXPECT_NEAR(glm::distance(rotated(q, {0, 1, 0}), frame.bitangent), 0.0, kError);
    }
  }
}

TEST(Frames, OfTheQuaternionAreThePublishedOnesAboveTheHorizonAndTurnedOverBelow) {
  for_each_normal<double>([](Direction n) {
    const auto corrected = quaternion_frame(n);
    const auto upper = published_quaternion_frame(n.z < 0.0 ? -n : n);
    EXPECT_EQ(corrected.tangent, upper.tangent);
    EXPECT_EQ(corrected.bitangent, n.z < 0.0 ? -upper.bitangent : upper.bitangent);
  });
}

template <class T>
bool is_number(const FrameOf<T>& frame) {
  return std::isfinite(orthonormality_error(frame));
}

TEST(Frames, OfBareFormulasAreNotNumbersAtThePoles) {
  for (const double pole : {-1.0, 1.0}) {
    const Direction n = {0.0, 0.0, pole};
    EXPECT_FALSE(is_number(bare_tangent_frame(n)));
    EXPECT_FALSE(is_number(bare_quaternion_frame(n)));
    EXPECT_TRUE(is_number(tangent_frame(n)));
    EXPECT_TRUE(is_number(published_quaternion_frame(n)));
    EXPECT_EQ(is_number(bare_rotation_frame(n)), pole > 0.0);
  }
}

double error_near_nadir(FrameOf<double> (*construct)(Direction), double distance) {
  return orthonormality_error(construct(near_pole<double>(-1.0, distance, 0.7)));
}

// 1 + n.z = d^2/2 is rounded by 2^-53 at the most (n.z is a multiple of that), and n.x^2 over it is
// 1 + cos(2 phi): an entry is off by up to 4 times 2^-53 / d^2, a squared length by twice that and
// the products with n.z by as much.
TEST(Frames, AsPublishedLoseTheSquareOfTheDistanceFromTheNadir) {
  double largest = 0.0;
  for (const double distance : {1.1e-5, 1.3e-5, 1.7e-5, 1e-4, 1.3e-4, 1e-3, 1.1e-3, 1e-2}) {
    const double unit = 0x1p-53 / (distance * distance);
    const double error = error_near_nadir(published_quaternion_frame<double>, distance);
    EXPECT_LE(error, 16.0 * unit) << distance;
    EXPECT_LE(error_near_nadir(quaternion_frame<double>, distance), kRoundings<double>) << distance;
    largest = std::max(largest, error / unit);
  }
  EXPECT_GE(largest, 0.1);
}

// Its tangents are x and y, and n leans away from them by the distance.
TEST(Frames, OfFrisvadAreAsFarOffAsTheNormalIsFromTheNadirInsideTheirException) {
  for (const double distance : {1e-9, 1e-6, 1e-4, 4e-4}) {
    const double lean = std::sin(distance) * std::max(std::cos(0.7), std::sin(0.7));
    EXPECT_NEAR(error_near_nadir(frisvad_frame<double>, distance), lean, 1e-15) << distance;
  }
}

TEST(FrameErrors, HaveALineOfEveryConstructionPrecisionAndPole) {
  const std::vector<double> distances = {1e-6, 1e-3, 1.0};
  const std::vector<FrameError> rows = frame_errors(distances);
  ASSERT_EQ(rows.size(), frame_constructions().size() * 2 * 2 * distances.size());
  std::set<std::string> lines;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].distance, distances[i % distances.size()]);
    lines.insert(std::string(rows[i].construction) + (rows[i].is_float ? " float" : " double") +
                 (rows[i].is_nadir ? " nadir" : " zenith"));
  }
  EXPECT_EQ(lines.size(), rows.size() / distances.size());
}

// The chart in words: what keeps its digits, what loses them, and where.
TEST(FrameErrors, ShowWhatEachConstructionLoses) {
  const std::vector<double> distances = {1e-6, 2e-3};
  for (const FrameError& row : frame_errors(distances)) {
    SCOPED_TRACE(testing::Message() << row.construction << ", float " << row.is_float << ", nadir "
                                    << row.is_nadir << ", " << row.distance);
    const double allowed = row.is_float ? kRoundings<float> : kRoundings<double>;
    const bool divides =
        row.construction == "frisvad" || row.construction == "quaternion, published";
    if (divides && row.is_nadir) {
      EXPECT_GT(row.error, row.distance < 1e-3 ? 5e-7 : 1000.0 * allowed);
    } else if (row.construction == "quaternion") {
      EXPECT_LE(row.error, row.distance < 1e-3 ? 1e-5 : 1000.0 * allowed);
    } else {
      EXPECT_LE(row.error, allowed);
    }
  }
  const double at_pole[] = {0.0};
  for (const FrameError& row : frame_errors(at_pole)) {
    const bool bare = row.construction == "tangent frame" || row.construction == "quaternion";
    EXPECT_EQ(std::isnan(row.error), bare) << row.construction;
  }
}

}  // namespace
}  // namespace lightproof
