#include "lightproof/warp/sphere_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

// Where the arc cosine is steep, near the poles, what rounding does to z moves t by its root.
TEST(UniformDirections, LieAtTheirPlacesOnTheMap) {
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
    uniform_directions(s, u, {x, y, z, t});
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
  }
}

}  // namespace
}  // namespace lightproof
