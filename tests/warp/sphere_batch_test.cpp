#include "lightproof/warp/sphere_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lightproof/warp/lat_long.h"
#include "tests/core/kinds_of_vectors.h"
#include "tests/core/whole_vectors.h"

namespace lightproof {
namespace {

using Numbers = std::vector<double>;

// Where the arc cosine is steep, near the poles, what rounding does to z moves t by its root.
TEST(UniformDirections, LieAtTheirPositionsOnTheMap) {
  for (const std::size_t size : {0U, 1U, 7U, 8U, 9U, 1001U}) {
    std::vector<double> s(size);
    std::vector<double> u(size);
    for (std::size_t i = 0; i < size; ++i) {
      s[i] = std::fmod(0.6180339887498949 * static_cast<double>(i), 1.0);
      u[i] = size == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(size - 1);
    }
    std::vector<double> x(size);
    std::vector<double> y(size);
    std::vector<double> z(size);
    std::vector<double> t(size);
    for_each_kind_of_vector([&](const char* vectors) {
      SCOPED_TRACE(vectors);
      expect_whole_vectors(vectors, uniform_directions(s, u, {x, y, z, t}), size);
      for (std::size_t i = 0; i < size; ++i) {
        const double sine = std::sqrt(1.0 - (2.0 * u[i] - 1.0) * (2.0 * u[i] - 1.0));
        const double phi = kPi - 2.0 * kPi * s[i];
        EXPECT_NEAR(x[i], sine * std::cos(phi), 2e-15);
        EXPECT_NEAR(y[i], sine * std::sin(phi), 2e-15);
        EXPECT_NEAR(z[i], 2.0 * u[i] - 1.0, 1e-15);
        const Direction expected = direction_from_square({s[i], t[i]});
        EXPECT_NEAR(x[i], expected.x, 4e-8);
        EXPECT_NEAR(y[i], expected.y, 4e-8);
        EXPECT_NEAR(z[i], expected.z, 4e-15);
      }
    });
  }
}

TEST(DirectionsOfPositions, AreThoseOfOnePositionEach) {
  for (const std::size_t size : {0U, 1U, 7U, 8U, 9U, 1001U}) {
    Numbers s(size);
    Numbers t(size);
    for (std::size_t i = 0; i < size; ++i) {
      s[i] = std::fmod(0.6180339887498949 * static_cast<double>(i), 1.0);
      t[i] = size == 1 ? 1e-9 : static_cast<double>(i) / static_cast<double>(size - 1);
    }
    Numbers x(size);
    Numbers y(size);
    Numbers z(size);
    Numbers sine(size);
    for_each_kind_of_vector([&](const char* vectors) {
      SCOPED_TRACE(vectors);
      const std::size_t done = directions_of_positions(s, t, {x, y, z, sine});
      expect_whole_vectors(vectors, done, size);
      for (std::size_t i = 0; i < size; ++i) {
        const Direction expected = direction_from_square({s[i], t[i]});
        EXPECT_NEAR(x[i], expected.x, 5e-16);
        EXPECT_NEAR(y[i], expected.y, 5e-16);
        EXPECT_NEAR(z[i], expected.z, 5e-16);
        // Relative to its size at the poles, where densities are divided by it.
        EXPECT_NEAR(sine[i], sin_theta(t[i]), 5e-16 * sin_theta(t[i]));
      }
    });
  }
}

// And are what the vectors wrote: of a thousand sines and cosines some differ from those of the
// scalar code in their last bit.
TEST(UniformDirections, AreDrawnByVectors) {
  constexpr std::size_t kSize = 1003;
  std::vector<double> s;
  std::vector<double> u;
  for (std::size_t i = 0; i < kSize; ++i) {
    s.push_back(std::fmod(0.6180339887498949 * static_cast<double>(i), 1.0));
    u.push_back((static_cast<double>(i) + 0.5) / kSize);
  }
  for_each_kind_of_vector([&](const char* vectors) {
    SCOPED_TRACE(vectors);
    std::vector<double> x(kSize);
    std::vector<double> y(kSize);
    std::vector<double> z(kSize);
    std::vector<double> t(kSize);
    const std::size_t done = uniform_directions(s, u, {x, y, z, t});
    expect_whole_vectors(vectors, done, kSize);
    std::size_t different = 0;
    for (std::size_t i = 0; i < done; ++i) {
      const double sine = 2.0 * std::sqrt(u[i] * (1.0 - u[i]));
      different += x[i] == -sine * std::cos(2.0 * kPi * s[i]) ? 0U : 1U;
    }
    EXPECT_EQ(different > 0, done > 0);
  });
}

TEST(ApproximatePositions, AreThoseOfOneDirectionAtATime) {
  constexpr std::size_t kSize = 203;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> z;
  for (std::size_t i = 0; i < kSize; ++i) {
    const double t = static_cast<double>(i) / (kSize - 1);
    const Direction at = direction_from_square({std::fmod(0.618 * static_cast<double>(i), 1.0), t});
    x.push_back(at.x);
    y.push_back(at.y);
    z.push_back(at.z);
  }
  for_each_kind_of_vector([&](const char* vectors) {
    SCOPED_TRACE(vectors);
    std::vector<double> s(kSize);
    std::vector<double> t(kSize);
    approximate_positions(x, y, z, {s, t});
    for (std::size_t i = 0; i < kSize; ++i) {
      const SquarePoint expected = approximate_square_from_direction({x[i], y[i], z[i]});
      EXPECT_EQ(s[i], expected.s);
      EXPECT_EQ(t[i], expected.t);
    }
  });
}

}  // namespace
}  // namespace lightproof
